fn main() {
    for p in std::env::args().skip(1) {
        let d = symmetrizer::drawing::read(std::path::Path::new(&p), &Default::default()).unwrap();
        symmetrizer::drawing::write(&d, std::path::Path::new(&p.replace(".svg", ".png"))).unwrap();
    }
}
