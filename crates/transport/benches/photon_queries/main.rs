//! Times photon look-ups against kiddo's immutable tree: the same photons, the same places, one thread.
//!
//! `cargo bench -p hyaline-transport --bench photon_queries` first prints a table of ratios, measured in turns so that
//! a busy machine slows both alike, after checking that both find the same photons; then criterion's own times. After
//! `--`, a number sets how many photons there are (default 1,000,000), and `--table` ends it after the table.

mod sets;

use criterion::Criterion;
use hyaline_math::Vec3;
use hyaline_transport::photon::{All, Nearest, PointTree, Region};
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use std::hint::black_box;
use std::num::NonZero;
use std::time::Instant;

/// Rounds of the table, of which the fastest counts.
const ROUNDS: usize = 21;

/// Places of a batch that is timed as one.
const BATCH_SIZE: usize = 50;

/// Places at which photons are asked for.
const QUERY_COUNT: usize = 10_000;

fn main() {
    let count = std::env::args().find_map(|arg| arg.parse().ok()).unwrap_or(1_000_000);
    let rivals = Rivals::build(count);
    let questions = rivals.questions();
    print_table(&rivals, &questions);
    if std::env::args().any(|arg| arg == "--table") {
        return;
    }
    let mut criterion = Criterion::default().without_plots().sample_size(10);
    let is_filter = |arg: &String| !arg.starts_with('-') && arg.parse::<usize>().is_err();
    if let Some(filter) = std::env::args().skip(1).find(is_filter) {
        criterion = criterion.with_filter(filter);
    }
    for question in &questions {
        let mut group = criterion.benchmark_group(&question.name);
        for (order, places) in [("along pixels", &rivals.along_pixels), ("scattered", &rivals.scattered)] {
            let mut found = Nearest::new();
            group.bench_function(format!("hyaline/{order}"), |b| {
                b.iter(|| rivals.ours(&question.kind, places, &mut found));
            });
            group.bench_function(format!("kiddo/{order}"), |b| {
                b.iter(|| rivals.theirs(&question.kind, places))
            });
        }
        group.finish();
    }
}

/// Both trees, and the places.
struct Rivals {
    ours: PointTree<[u32; 2]>,
    theirs: ImmutableKdTree<f32, 3>,
    along_pixels: Vec<Vec3>,
    scattered: Vec<Vec3>,
}

/// What is asked at every place.
enum Kind {
    Nearest(usize),
    Within(f32),
}

struct Question {
    name: String,
    kind: Kind,
}

/// What came back, for comparison: photons, the sum of their numbers and that of their squared distances.
#[derive(Clone, Copy, Debug, Default)]
struct Answer {
    count: u64,
    items: u64,
    distance2: f64,
}

impl Rivals {
    fn build(count: usize) -> Self {
        let photons = sets::photons(count);
        let coordinates: Vec<[f32; 3]> = photons.iter().map(|p| p.to_array()).collect();
        let points = photons.iter().zip(0..).map(|(p, i)| (*p, [i, 0])).collect();
        let start = Instant::now();
        let ours = PointTree::build(points, 64);
        let our_time = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let theirs = ImmutableKdTree::new_from_slice(&coordinates).expect("there are photons");
        println!(
            "{count} photons: built in {our_time:.2} s, {:.1} bytes each; kiddo in {:.2} s",
            ours.bytes() as f64 / count as f64,
            start.elapsed().as_secs_f64()
        );
        Self {
            ours,
            theirs,
            along_pixels: sets::along_pixels(QUERY_COUNT),
            scattered: sets::scattered(QUERY_COUNT),
        }
    }

    /// The k-nearest questions, and two radii that find 60 and 1700 photons on average.
    fn questions(&self) -> Vec<Question> {
        let nearest = [50, 100, 200].map(|k| Question { name: format!("k = {k}"), kind: Kind::Nearest(k) });
        let within = [60.0, 1700.0].map(|mean| Question {
            name: format!("radius of about {mean} photons"),
            kind: Kind::Within(self.radius_of(mean)),
        });
        nearest.into_iter().chain(within).collect()
    }

    /// Radius at which the mean number of photons is `mean`, by bisection.
    fn radius_of(&self, mean: f64) -> f32 {
        let sample: Vec<Vec3> = self.scattered.iter().step_by(10).copied().collect();
        let (mut low, mut high) = (0.0, 0.5);
        for _ in 0..16 {
            let radius = 0.5 * (low + high);
            let count = self.ours(&Kind::Within(radius), &sample, &mut Nearest::new()).count;
            if count as f64 > mean * sample.len() as f64 { high = radius } else { low = radius }
        }
        low
    }

    fn ours(&self, kind: &Kind, places: &[Vec3], found: &mut Nearest) -> Answer {
        let mut answer = Answer::default();
        for &center in places {
            match *kind {
                Kind::Nearest(k) => {
                    self.ours.nearest(&Region { center, radius: f32::INFINITY, disc: None }, k, All, found);
                    for (distance2, i) in found.iter() {
                        answer = answer.with(distance2, self.ours.payload(i)[0]);
                    }
                }
                Kind::Within(radius) => {
                    let region = Region { center, radius, disc: None };
                    answer = self.ours.fold_within(&region, answer, |answer, i, distance2| {
                        answer.with(distance2, self.ours.payload(i)[0])
                    });
                }
            }
        }
        black_box(answer)
    }

    fn theirs(&self, kind: &Kind, places: &[Vec3]) -> Answer {
        let mut answer = Answer::default();
        for place in places {
            let center = place.to_array();
            match *kind {
                Kind::Nearest(k) => {
                    let k = NonZero::new(k).expect("k is positive");
                    let query = self.theirs.query(&center).nearest_n::<SquaredEuclidean<f32>>(k);
                    for found in query.unsorted().execute() {
                        answer = answer.with(found.distance, found.item);
                    }
                }
                Kind::Within(radius) => {
                    let query = self.theirs.query(&center).within::<SquaredEuclidean<f32>>(radius * radius);
                    query.unsorted().visit(|found| answer = answer.with(found.distance, found.item));
                }
            }
        }
        black_box(answer)
    }
}

impl Answer {
    #[inline]
    fn with(self, distance2: f32, item: u32) -> Self {
        Self {
            count: self.count + 1,
            items: self.items + u64::from(item),
            distance2: self.distance2 + f64::from(distance2),
        }
    }
}

/// Thousands of queries a second, and ratios.
fn print_table(rivals: &Rivals, questions: &[Question]) {
    println!("thousands of queries a second, along pixels / scattered");
    for Question { name, kind } in questions {
        let rates = [&rivals.along_pixels, &rivals.scattered].map(|places| compare(rivals, kind, places));
        let [pixels, scattered] = rates;
        let ratios = rates.map(|[ours, theirs]| ours / theirs);
        println!(
            "{name:28} {:7.1} / {:7.1}   kiddo {:7.1} / {:7.1}   ratio {:.2} / {:.2}, mean {:.2}",
            pixels[0],
            scattered[0],
            pixels[1],
            scattered[1],
            ratios[0],
            ratios[1],
            (ratios[0] * ratios[1]).sqrt()
        );
    }
}

/// Rates of ours and theirs. Each batch is so short that it is mostly done before anything interrupts it, and the fastest
/// round of each counts.
fn compare(rivals: &Rivals, kind: &Kind, places: &[Vec3]) -> [f64; 2] {
    let mut found = Nearest::new();
    let mut times = vec![[f64::INFINITY; 2]; places.len().div_ceil(BATCH_SIZE)];
    for _ in 0..ROUNDS {
        for (places, best) in places.chunks(BATCH_SIZE).zip(&mut times) {
            let (ours, our_time) = timed(|| rivals.ours(kind, places, &mut found));
            let (theirs, their_time) = timed(|| rivals.theirs(kind, places));
            check_equal(kind, ours, theirs);
            *best = [best[0].min(our_time), best[1].min(their_time)];
        }
    }
    [0, 1].map(|who| places.len() as f64 / times.iter().map(|best| best[who]).sum::<f64>() * 1e-3)
}

/// Both found the same. Of photons that are equally far as the k-th it is open which one is taken, so that the nearest are
/// compared by their distances.
fn check_equal(kind: &Kind, ours: Answer, theirs: Answer) {
    assert_eq!(ours.count, theirs.count);
    assert!((ours.distance2 - theirs.distance2).abs() <= 1e-9 * ours.distance2);
    if let Kind::Within(_) = kind {
        assert_eq!(ours.items, theirs.items);
    }
}

fn timed(work: impl FnOnce() -> Answer) -> (Answer, f64) {
    let start = Instant::now();
    let answer = work();
    (answer, start.elapsed().as_secs_f64())
}
