//! PLY: any document that it holds round-trips; no bytes make the reader panic.

use proptest::prelude::*;
use symmetrizer::shape::Document;
use symmetrizer::shape::document::{
    Kept, Layer, NO_ROW, Numbers, On, PlyForm, PlyKept, Role, Values,
};
use symmetrizer::shape::io::{self, Format};

use super::bytes_of;
use crate::shared::*;

const FORMS: [PlyForm; 3] = [PlyForm::Text, PlyForm::Little, PlyForm::Big];

/// `count` numbers of any one type.
fn numbers(count: usize) -> impl Strategy<Value = Numbers> {
    let size = count..count + 1;
    let list =
        |f: fn(Vec<u64>) -> Numbers| prop::collection::vec(any::<u64>(), size.clone()).prop_map(f);
    prop_oneof![
        list(|v| Numbers::I8(v.into_iter().map(|v| v as i8).collect())),
        list(|v| Numbers::U8(v.into_iter().map(|v| v as u8).collect())),
        list(|v| Numbers::I16(v.into_iter().map(|v| v as i16).collect())),
        list(|v| Numbers::U16(v.into_iter().map(|v| v as u16).collect())),
        list(|v| Numbers::I32(v.into_iter().map(|v| v as i32).collect())),
        list(|v| Numbers::U32(v.into_iter().map(|v| v as u32).collect())),
        list(|v| Numbers::F32(v.into_iter().map(single).collect())),
        list(|v| Numbers::F64(v.into_iter().map(double).collect())),
    ]
}

/// Any single, infinities and denormals too, but NaN.
fn single(bits: u64) -> f32 {
    let value = f32::from_bits(bits as u32);
    if value.is_nan() { -0.0 } else { value }
}

fn double(bits: u64) -> f64 {
    let value = f64::from_bits(bits);
    if value.is_nan() { -0.0 } else { value }
}

fn rows(count: usize, width: usize) -> impl Strategy<Value = Values> {
    numbers(count * width).prop_map(move |numbers| Values::Rows { width, numbers })
}

fn lists(count: usize) -> impl Strategy<Value = Values> {
    let lengths = prop::collection::vec(prop_oneof![9 => 0..4_u32, 1 => 250..300_u32], count);
    lengths.prop_flat_map(|lengths| {
        let mut starts = vec![0];
        starts.extend(lengths.iter().scan(0, |end, n| {
            *end += n;
            Some(*end)
        }));
        let total = starts[lengths.len()] as usize;
        numbers(total).prop_map(move |numbers| Values::Lists {
            starts: starts.clone(),
            numbers,
        })
    })
}

fn names(count: usize) -> impl Strategy<Value = Values> {
    prop::collection::vec(any::<String>(), 1..5).prop_flat_map(move |names| {
        let known = 0..names.len() as u32;
        let of = prop::collection::vec(prop_oneof![known, Just(NO_ROW)], count);
        of.prop_map(move |of| Values::Names {
            names: names.clone(),
            of,
        })
    })
}

/// A layer in a third of the documents, or two.
fn some(
    name: &str,
    on: On,
    role: Role,
    values: impl Strategy<Value = Values> + 'static,
) -> BoxedStrategy<Option<Layer>> {
    let name = name.to_owned();
    let layer = values.prop_map(move |values| Layer {
        name: name.clone(),
        on,
        role,
        values,
    });
    prop::option::weighted(0.4, layer).boxed()
}

/// 8-bit colours: others become those where they come from another format.
fn bytes(count: usize, width: usize) -> impl Strategy<Value = Values> {
    prop::collection::vec(any::<u8>(), count * width).prop_map(move |v| Values::Rows {
        width,
        numbers: Numbers::U8(v),
    })
}

fn layers(vertices: usize, faces: usize, corners: usize) -> impl Strategy<Value = Vec<Layer>> {
    use {On::*, Role::*};
    let on_vertices = [
        some("nx ny nz", Vertex, Normal, rows(vertices, 3)),
        some("red green blue", Vertex, Color(0), bytes(vertices, 3)),
        some(
            "red2 green2 blue2 alpha2",
            Vertex,
            Color(2),
            bytes(vertices, 4),
        ),
        some("s t", Vertex, TexCoord(0), rows(vertices, 2)),
        some(
            "texture_u1 texture_v1 texture_w1",
            Vertex,
            TexCoord(1),
            rows(vertices, 3),
        ),
        some("quality", Vertex, Other, rows(vertices, 1)),
        some("near", Vertex, Other, lists(vertices)),
    ];
    let on_faces = [
        some("red green blue alpha", Face, Color(0), bytes(faces, 4)),
        some("nx ny nz", Face, Normal, rows(faces, 3)),
        some("texcoord", Corner, TexCoord(0), rows(corners, 2)),
        some("texcoord3", Corner, TexCoord(3), rows(corners, 2)),
        some("material", Face, Material, names(faces)),
        some("group", Face, Group, names(faces)),
        some("object", Face, Object, names(faces)),
        some("smoothing", Face, Smoothing, names(faces)),
        some("flags", Face, Other, rows(faces, 1)),
        some("tags", Face, Other, lists(faces)),
    ];
    (on_vertices, on_faces).prop_map(|(a, b)| a.into_iter().chain(b).flatten().collect())
}

/// Documents of what PLY holds, in each of its forms.
fn any_document() -> impl Strategy<Value = Document> {
    let shape = (3..12_usize).prop_flat_map(|vertices| {
        let position = prop::array::uniform3(any::<u64>().prop_map(double));
        let polygon = prop::collection::vec(0..vertices as u32, 3..7);
        (
            prop::collection::vec(position, vertices),
            prop::collection::vec(polygon, 1..12),
        )
    });
    shape.prop_flat_map(|(positions, polygons)| {
        let polygons: Vec<&[u32]> = polygons.iter().map(Vec::as_slice).collect();
        let mesh = mesh(&positions, &polygons);
        let corners = polygons.iter().map(|p| p.len()).sum();
        let layers = layers(positions.len(), polygons.len(), corners);
        let form = prop::sample::select(FORMS.to_vec());
        (layers, form).prop_map(move |(layers, form)| Document {
            mesh: mesh.clone(),
            layers,
            kept: Kept::Ply(PlyKept {
                form,
                ..PlyKept::default()
            }),
        })
    })
}

/// Debug output tells -0 from 0.
fn bits(document: &Document) -> String {
    format!("{:?} {:?}", document.mesh, document.layers)
}

/// A small file of each form with lists, names and an element of its own.
fn small_files() -> Vec<Vec<u8>> {
    let text = "ply\nformat ascii 1.0\ncomment one\nelement vertex 4\nproperty float x\n\
        property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n\
        property uchar blue\nproperty list uchar short near\nelement edge 2\n\
        property int a\nproperty int b\nelement face 2\n\
        property list uchar int vertex_indices\nproperty list uchar float texcoord\n\
        property int material\ncomment material 0 wool\nelement tristrips 1\n\
        property list int int vertex_indices\nend_header\n\
        0 0 0 1 2 3 0\n1 0 0 1 2 3 1 5\n0 1 0 1 2 3 2 6 7\n1 1 0 1 2 3 0\n0 1\n2 3\n\
        3 0 1 2 6 0 0 1 0 0 1 0\n3 2 1 3 6 0 0 1 0 0 1 -1\n6 0 1 2 3 -1 2\n";
    // Strips are written as faces, so the binary forms are made by hand.
    let (head, _) = text.split_at(text.find("end_header").unwrap() + 11);
    let mut files = vec![text.as_bytes().to_vec()];
    for (name, big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        let mut bytes = head.replace("ascii", name).into_bytes();
        let mut put = |number: &[u8]| match big {
            true => bytes.extend(number.iter().rev()),
            false => bytes.extend(number),
        };
        for _ in 0..4 {
            (0..3).for_each(|i| put(&f32::to_le_bytes(i as f32)));
            (0..4).for_each(|_| put(&[0]));
        }
        (0..4).for_each(|i| put(&i32::to_le_bytes(i)));
        for _ in 0..2 {
            put(&[3]);
            (0..3).for_each(|i| put(&i32::to_le_bytes(i)));
            put(&[6]);
            (0..6).for_each(|i| put(&f32::to_le_bytes(i as f32)));
            put(&i32::to_le_bytes(-1));
        }
        [6, 0, 1, 2, 3, -1, 0]
            .iter()
            .for_each(|&i| put(&i32::to_le_bytes(i)));
        files.push(bytes);
    }
    files
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn any_document_round_trips(document in any_document()) {
        let again = self::document(bytes_of(&document), Format::Ply);
        prop_assert_eq!(bits(&again), bits(&document));
        prop_assert!(io::losses(&document, Format::Ply).is_empty());
        // What is read from PLY is written as it was, header and all.
        prop_assert!(bytes_of(&again) == bytes_of(&self::document(bytes_of(&again), Format::Ply)));
    }

    #[test]
    fn changed_bytes_never_panic(
        changes in prop::collection::vec((0.0..1.0_f64, any::<u8>()), 1..6),
        cut in prop::option::of(0.0..1.0_f64),
    ) {
        for mut bytes in small_files() {
            for &(place, byte) in &changes {
                let at = (place * bytes.len() as f64) as usize;
                bytes[at] = byte;
            }
            if let Some(cut) = cut {
                bytes.truncate((cut * bytes.len() as f64) as usize);
            }
            if let Ok(document) = io::decode(bytes, Format::Ply) {
                let again = self::document(bytes_of(&document), Format::Ply);
                prop_assert_eq!(again.mesh.polygons, document.mesh.polygons);
            }
        }
    }
}

#[test]
fn small_files_are_good_to_start_with() {
    let files = small_files();
    for bytes in files {
        let read = document(bytes, Format::Ply);
        assert_eq!(read.mesh.polygons.len(), 4);
        assert_eq!(read.layers.len(), 4);
    }
}
