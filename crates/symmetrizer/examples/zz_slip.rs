#![allow(clippy::print_stdout, missing_docs)]
use symmetrizer::{Context, sample::{sample, SampleParams}, slip::{continuous, SlipParams}, shape::{io, working::Working}};
fn main() {
    for path in std::env::args().skip(1) {
        let mesh = io::read(path.as_ref()).unwrap().mesh;
        let working = Working::new(&mesh).unwrap();
        let s = sample(&working.surface, &SampleParams::default(), &mut Context::new(7)).unwrap();
        let t0 = std::time::Instant::now();
        let found = continuous(&s, &SlipParams::default());
        println!("{path}: {} samples {:.0} ms", s.list.len(), t0.elapsed().as_secs_f64()*1e3);
        for c in found { println!("   {:?} {:.3} rms {:.4} axis {:?} p {:?} pitch {:.3}", c.slip, c.area_fraction, c.rms, c.axis.map(|a| a.as_slice().to_vec()), c.point.coords.as_slice(), c.pitch); }
    }
}
