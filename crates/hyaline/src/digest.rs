//! What a film's passes belong to: two films may be added up only where all of this is the same.
//!
//! Covered are the scene's content (files it names included), integrator and the settings it uses, size and filter of the
//! picture, camera, crop, seed, and the version of the algorithms; not threads, length of run, outputs or paths.

use crate::plan::Plan;
use crate::used_settings;
use hyaline_film::{DigestPart, FilmHeader};
use hyaline_render::ALGORITHM_VERSION;
use hyaline_scene::SceneDescription;
use serde::Serialize;
use std::io;

/// The header of the plan's film.
pub(crate) fn film_header(scene: &SceneDescription, plan: &Plan) -> FilmHeader {
    let part = |name: &str, value: String| DigestPart { name: name.to_owned(), value };
    let settings = &plan.settings;
    let parts = vec![
        part("algorithm version", ALGORITHM_VERSION.to_string()),
        part("scene", content(scene)),
        part("integrator", plan.integrator.name().to_owned()),
        part("settings", used_settings::in_words(plan.integrator.name(), settings)),
        part("filter", format!("{:?}", scene.film.filter)),
        part("camera", plan.view.camera.to_string()),
    ];
    FilmHeader {
        width: plan.view.width,
        height: plan.view.height,
        crop: plan.crop,
        seed: settings.seed,
        parts,
    }
}

/// Hash of all that can be seen or looked through.
fn content(scene: &SceneDescription) -> String {
    let SceneDescription { cameras, media, materials, textures, objects, lights, surrounding, .. } = scene;
    hash(&(cameras, media, materials, textures, objects, lights, surrounding))
}

/// Hash of a value's JSON, which is never held as a whole.
fn hash(value: &impl Serialize) -> String {
    let mut hasher = Hasher(blake3::Hasher::new());
    // Descriptions hold numbers, strings and enums alone, and the writer never fails.
    let written = serde_json::to_writer(io::BufWriter::with_capacity(1 << 16, &mut hasher), value);
    debug_assert!(written.is_ok(), "{written:?}");
    hasher.0.finalize().to_hex().to_string()
}

/// A hasher to write to.
struct Hasher(blake3::Hasher);

impl io::Write for Hasher {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Cli;
    use clap::Parser;
    use hyaline_scene::{IndexDescription, Located, MediumDescription, Source};

    fn header(words: &str, mut scene: SceneDescription) -> FilmHeader {
        let words = std::iter::once("hyaline").chain(words.split_whitespace());
        let plan = crate::plan::plan(&Cli::parse_from(words).render, &mut scene).expect("a plan");
        film_header(&scene, &plan)
    }

    fn difference(a: &FilmHeader, b: &FilmHeader) -> String {
        a.check_same(b).expect_err("they differ").to_string()
    }

    #[test]
    fn each_option_that_decides_on_the_picture_makes_another_digest() {
        let plain = header("", SceneDescription::default());
        for (words, what) in [
            ("--seed 2", "seed"),
            ("--integrator whitted", "integrator"),
            ("--crop 1,2,3,4", "crop"),
            ("--size 64x48", "size"),
        ] {
            assert!(
                difference(&plain, &header(words, SceneDescription::default())).contains(what),
                "{words}"
            );
        }
    }

    #[test]
    fn options_that_do_not_decide_on_the_picture_make_none() {
        let plain = header("", SceneDescription::default());
        let words = "--threads 3 --spp 5 --time 3 -o a.png --film b.film --exposure 2";
        assert_eq!(plain, header(words, SceneDescription::default()));
    }

    #[test]
    fn the_content_of_the_scene_counts_and_its_places_do_not() {
        let medium = |priority: i32| MediumDescription {
            priority,
            ..MediumDescription::clear("glass", IndexDescription::Constant(1.5))
        };
        let scene = |priority: i32, file: &str| SceneDescription {
            media: vec![Located::new(medium(priority), Source::file(file))],
            ..SceneDescription::default()
        };
        let plain = header("", scene(0, "a.toml"));
        assert_eq!(plain, header("", scene(0, "b.toml")));
        assert!(difference(&plain, &header("", scene(1, "a.toml"))).contains("scene"));
    }
}
