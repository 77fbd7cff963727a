use hyaline_film::*;
use std::path::Path;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    for pair in a[2..].chunks(2) {
        let x = read_image(Path::new(&pair[0])).unwrap();
        let y = read_image(Path::new(&pair[1])).unwrap();
        let t = std::time::Instant::now();
        let c = compare(&x, &y, a[1].parse().unwrap()).unwrap();
        println!("{} {:?}", serde_json::to_string(&c).unwrap(), t.elapsed());
        write_image(Path::new("/tmp/diff.png"), &difference_image(&x, &y).unwrap(), 1.0).unwrap();
        write_image(Path::new("/tmp/ref.png"), &y, 1.0).unwrap();
        write_image(Path::new("/tmp/out.exr"), &x, 1.0).unwrap();
    }
    // speed
    let w = 640;
    let h = 480;
    let rect = Rect { x0: 0, y0: 0, x1: w, y1: h };
    let mut f = Film::new(FilmHeader { width: w, height: h, crop: rect, seed: 0, parts: vec![] }).unwrap();
    let s: Vec<PixelSample> = (0..w * h)
        .map(|i| PixelSample {
            beauty: [i as f32 * 1e-5, 0.3, 0.7],
            albedo: [0.5; 3],
            normal: [0.1, 0.2, 0.3],
            depth: Some(2.0),
            object: 1,
        })
        .collect();
    let t = std::time::Instant::now();
    for p in 0..16 {
        f.add_tile(p, rect, &s);
        f.finish_pass(p).unwrap();
    }
    println!("add {:.1} ns/sample", t.elapsed().as_secs_f64() * 1e9 / 16.0 / (w * h) as f64);
    let t = std::time::Instant::now();
    let b = f.to_bytes();
    println!("bytes/pixel {} in {:?}", b.len() / (w * h) as usize, t.elapsed());
    let t = std::time::Instant::now();
    assert!(Film::from_bytes(&b).unwrap() == f);
    println!("read {:?}", t.elapsed());
    let t = std::time::Instant::now();
    f.write(Path::new("/tmp/x.film")).unwrap();
    println!("write {:?}", t.elapsed());
    let t = std::time::Instant::now();
    write_image(Path::new("/tmp/x.exr"), &develop(&f), 1.0).unwrap();
    println!("exr {:?}", t.elapsed());
    let t = std::time::Instant::now();
    write_image(Path::new("/tmp/x.png"), &develop(&f), 1.0).unwrap();
    println!("png {:?}", t.elapsed());
}
