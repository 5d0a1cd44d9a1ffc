//! Properties of every format.

use proptest::prelude::*;
use symmetrizer::shape::io::{self, Format};
use symmetrizer::shape::{Document, Mesh};

use crate::rich::rich;
use crate::shared::*;

fn any_mesh() -> impl Strategy<Value = Mesh> {
    let coordinate = any::<f64>().prop_filter("finite", |c| c.is_finite());
    let positions = prop::collection::vec(prop::array::uniform3(coordinate), 3..40);
    positions.prop_flat_map(|positions| {
        let corner = 0..positions.len() as u32;
        let faces = prop::collection::vec(prop::collection::vec(corner, 3..7), 1..40);
        faces.prop_map(move |faces| {
            let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
            mesh(&positions, &faces)
        })
    })
}

/// Debug output tells -0 from 0.
fn bits(mesh: &Mesh) -> String {
    format!("{mesh:?}")
}

proptest! {
    /// What a format has taken in, whatever it is, it gives back to the last bit.
    #[test]
    fn read_write_read_is_the_identity(mask in any::<u32>(), seed in any::<u64>()) {
        for format in Format::ALL {
            let first = document(encoded_document(&rich(mask, seed), format), format);
            let second = document(encoded_document(&first, format), format);
            prop_assert_eq!(format!("{first:?}"), format!("{second:?}"), "{:?}", format);
            prop_assert_eq!(io::losses(&first, format), Vec::<String>::new(), "{:?}", format);
        }
    }

    /// What a format does not say that it loses, it has.
    #[test]
    fn layers_survive_or_are_named(mask in any::<u32>(), seed in any::<u64>()) {
        let rich = rich(mask, seed);
        for format in Format::ALL {
            for layer in &rich.layers {
                let alone = Document {
                    layers: vec![layer.clone()],
                    ..rich.mesh.clone().into()
                };
                let named = io::losses(&alone, format).iter().any(|l| l.contains("(per "));
                let read = document(encoded_document(&alone, format), format);
                let there = !read.layers.is_empty();
                prop_assert!(named || there, "{:?}: {:?} on {:?}", format, layer.role, layer.on);
            }
        }
    }

    #[test]
    fn any_mesh_round_trips(mesh in any_mesh()) {
        for format in [Format::Obj, Format::Off, Format::Ply] {
            let again = decoded(encoded(&mesh, format), format);
            prop_assert_eq!(bits(&again), bits(&mesh));
        }
    }

    #[test]
    fn a_cut_or_changed_file_never_panics(
        cut in 0.0..1.0_f64, place in 0.0..1.0_f64, byte in any::<u8>(),
    ) {
        for format in Format::ALL {
            let mut bytes = encoded(&pyramid(), format);
            let at = (place * bytes.len() as f64) as usize;
            bytes[at] = byte;
            let _ = io::decode(bytes.clone(), format);
            bytes.truncate((cut * bytes.len() as f64) as usize);
            let _ = io::decode(bytes, format);
        }
    }
}
