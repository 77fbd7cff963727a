//! Memory: sums are all that a render keeps, however long it is.

use crate::support::Workshop;

#[test]
fn many_passes_take_no_more_memory_than_few() {
    let workshop = Workshop::new();
    let peak = |passes: u32| {
        let words =
            format!("scene.toml --integrator merging --threads 2 --size 8x6 --spp {passes} -o a.png --json");
        workshop.succeed(&words).json()["peak_memory_bytes"].as_u64()
    };
    let (Some(few), Some(many)) = (peak(10), peak(400)) else { return };
    // What passes under way at a time need varies a little; forty times as many maps of photons would stand out.
    assert!(many < few + few / 2, "{few} bytes after 10 passes, {many} after 400");
}
