//! Thousands of damaged files: every one gives a scene or an error, none a panic, none takes long.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use hyaline_formats::{image_from_bytes, load_mitsuba_text, load_toml_text, mesh_from_bytes};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::time::Instant;

const TOML: &str = include_str!("scenes/everything.toml");
const XML: &str = include_str!("scenes/everything.xml");
const TOML_FINISHES: &str = include_str!("scenes/finishes.toml");
const XML_FINISHES: &str = include_str!("scenes/finishes.xml");
const OLDER_XML: &str = include_str!("scenes/older.xml");

/// Damaged variants of each file.
const ROUNDS: u32 = 8000;
/// Bound on the time for one variant, seconds; they take under a millisecond.
const PATIENCE: f64 = 2.0;

/// Random numbers with a fixed seed.
///
/// Source: Knuth, The Art of Computer Programming, vol. 2, 3rd ed., §3.3.4, table 1 (MMIX).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit.max(1)
    }
}

const NUMBERS: [&str; 16] = [
    "nan",
    "inf",
    "-inf",
    "0",
    "-1",
    "1e400",
    "1e-320",
    "-0.0",
    "1e38",
    "4294967296",
    "9223372036854775807",
    "0.5",
    "\"2 mm\"",
    "[1, 2]",
    "true",
    "",
];

/// Damages a file in one to three of the ways that happen, or that attackers think of.
fn damage(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..1 + random.below(3) {
        if bytes.is_empty() {
            break;
        }
        let at = random.below(bytes.len());
        let length = (1 + random.below(40)).min(bytes.len() - at);
        match random.below(7) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = random.below(256) as u8,
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..at + length)),
            4 => {
                let copy = bytes[at..at + length].to_vec();
                let target = random.below(bytes.len());
                bytes.splice(target..target, copy);
            }
            5 => swap_words(&mut bytes, random),
            _ => replace_number(&mut bytes, random),
        }
    }
    bytes
}

/// Exchanges two words.
fn swap_words(bytes: &mut Vec<u8>, random: &mut Random) {
    let mut words: Vec<Vec<u8>> = bytes.split(|byte| *byte == b' ').map(<[u8]>::to_vec).collect();
    let (a, b) = (random.below(words.len()), random.below(words.len()));
    words.swap(a, b);
    *bytes = words.join(&b' ');
}

/// Puts another number in the place of one.
fn replace_number(bytes: &mut Vec<u8>, random: &mut Random) {
    let starts: Vec<usize> = (1..bytes.len())
        .filter(|i| {
            bytes[*i].is_ascii_digit() && !bytes[*i - 1].is_ascii_alphanumeric() && bytes[*i - 1] != b'.'
        })
        .collect();
    if starts.is_empty() {
        return;
    }
    let start = starts[random.below(starts.len())];
    let is_number = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let end = start + bytes[start..].iter().take_while(|byte| is_number(byte)).count();
    bytes.splice(start..end, NUMBERS[random.below(NUMBERS.len())].bytes());
}

/// Feeds damaged variants of `bytes` to `read`; returns how many it accepted.
fn feed(bytes: &[u8], seed: u64, rounds: u32, mut read: impl FnMut(&[u8]) -> bool) -> u32 {
    let mut random = Random(seed);
    let mut accepted = 0;
    for round in 0..rounds {
        let variant = damage(bytes, &mut random);
        let start = Instant::now();
        accepted += u32::from(read(&variant));
        assert!(start.elapsed().as_secs_f64() < PATIENCE, "variant {round} takes too long");
    }
    accepted
}

/// Feeds variants of a file, which is sound itself; some must be refused.
fn feed_file(bytes: &[u8], seed: u64, read: impl Fn(&[u8]) -> bool) {
    assert!(read(bytes), "the sound file is accepted");
    assert!(feed(bytes, seed, ROUNDS, read) < ROUNDS, "some variants are refused");
}

#[test]
fn damaged_toml_scenes_are_survived() {
    let read = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes);
        match load_toml_text(&text, "a.toml", Path::new("."), &[]) {
            Ok(_) => true,
            Err(error) => {
                assert!(error.source.is_some() && !error.message.is_empty(), "{error:?}");
                false
            }
        }
    };
    for (scene, rounds) in [(TOML, ROUNDS), (TOML_FINISHES, ROUNDS / 4)] {
        assert!(read(scene.as_bytes()));
        let accepted = feed(scene.as_bytes(), 1, rounds, read);
        assert!(accepted > 0 && accepted < rounds, "{accepted}");
    }
}

#[test]
fn damaged_overrides_are_survived() {
    let mut random = Random(2);
    for _ in 0..ROUNDS {
        let pairs = [
            "camera.fov=30",
            "object.ball.radius=2 mm",
            "film.filter={kind='tent'}",
            "light.3.radiance=[1,2,3]",
        ];
        let text = damage(pairs[random.below(pairs.len())].as_bytes(), &mut random);
        let text = String::from_utf8_lossy(&text);
        let (key, value) = text.split_once('=').unwrap_or((&text, ""));
        let overrides = [(key.to_owned(), value.to_owned())];
        let _ = load_toml_text(TOML, "a.toml", Path::new("."), &overrides);
        let _ = load_mitsuba_text(XML, "a.xml", Path::new("."), &overrides);
    }
}

#[test]
fn damaged_mitsuba_scenes_are_survived() {
    let read = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes);
        load_mitsuba_text(&text, "a.xml", Path::new("."), &[]).is_ok()
    };
    for (scene, rounds) in [(XML, ROUNDS), (XML_FINISHES, ROUNDS / 4)] {
        assert!(read(scene.as_bytes()));
        let accepted = feed(scene.as_bytes(), 3, rounds, read);
        assert!(accepted > 0 && accepted < rounds, "{accepted}");
    }
}

/// A folder with the files that the older scene names.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).unwrap();
    write("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m0\nf 1 2 3\nusemtl m1\nf 3 2 1\n");
    write("a.serialized", &serialized(&serialized_content()));
    write("a.vol", &vol());
    let mut sky = b"Pf 1 1 -1.0\n".to_vec();
    sky.extend(2f32.to_le_bytes());
    write("a.pfm", &sky);
    write("a.spd", b"# nm, value\n400 0.5\n700 1\n");
    write("part.xml", b"<shape type='sphere' id='included'><float name='radius' value='$n'/></shape>");
    folder
}

#[test]
fn damaged_older_mitsuba_scenes_are_survived() {
    let folder = folder();
    let read = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes);
        load_mitsuba_text(&text, "a.xml", folder.path(), &[]).is_ok()
    };
    let sound = load_mitsuba_text(OLDER_XML, "a.xml", folder.path(), &[]).unwrap();
    assert_eq!((sound.objects.len(), sound.lights.len()), (11, 6), "the sound scene is read as a whole");
    let accepted = feed(OLDER_XML.as_bytes(), 11, ROUNDS / 2, read);
    assert!(accepted > 0 && accepted < ROUNDS / 2, "{accepted}");
}

#[test]
fn damaged_includes_are_survived() {
    let folder = folder();
    let part = b"<scene version='3.0.0'><default name='b' value='$n$n'/><include filename='part.xml'/>\
                 <shape type='sphere' id='s'/><alias id='s' as='t'/><path value='..'/>\
                 <shape type='instance'><ref id='t'/></shape></scene>";
    let text = "<scene version='3.0.0'><default name='n' value='2'/><sensor type='perspective'/>\
                <shape type='cube'/><include filename='part.xml'/></scene>";
    let accepted = feed(part, 12, ROUNDS / 4, |bytes| {
        fs::write(folder.path().join("part.xml"), bytes).unwrap();
        load_mitsuba_text(text, "a.xml", folder.path(), &[]).is_ok()
    });
    assert!(accepted < ROUNDS / 4, "{accepted}");
}

/// A mesh of a `.serialized` file before it is compressed.
fn serialized_content() -> Vec<u8> {
    let mut content = b"name\0".to_vec();
    content.extend(0x100bu32.to_le_bytes());
    content.extend([3u64, 1].iter().flat_map(|n| n.to_le_bytes()));
    (0..9 + 9 + 6 + 9).for_each(|i| content.extend((i as f32 * 0.25).to_le_bytes()));
    content.extend([0u32, 1, 2].iter().flat_map(|n| n.to_le_bytes()));
    content
}

/// A `.serialized` file of one mesh.
fn serialized(content: &[u8]) -> Vec<u8> {
    let mut bytes = vec![0x1c, 0x04, 4, 0];
    let mut encoder = ZlibEncoder::new(&mut bytes, Compression::fast());
    encoder.write_all(content).unwrap();
    encoder.finish().unwrap();
    bytes.extend(0u64.to_le_bytes());
    bytes.extend(1u32.to_le_bytes());
    bytes
}

#[test]
fn damaged_serialized_meshes_are_survived() {
    let read = |bytes: &[u8]| mesh_from_bytes(bytes, "a.serialized").is_ok();
    let content = serialized_content();
    feed_file(&serialized(&content), 13, read);
    feed_file(&content, 14, |content| read(&serialized(content)));
}

/// A grid of bytes.
fn vol() -> Vec<u8> {
    let mut bytes = b"VOL\x03".to_vec();
    bytes.extend([3u32, 2, 2, 2, 1].iter().flat_map(|n| n.to_le_bytes()));
    bytes.extend([0f32, 0.0, 0.0, 1.0, 1.0, 1.0].iter().flat_map(|n| n.to_le_bytes()));
    bytes.extend(0..8u8);
    bytes
}

#[test]
fn damaged_grids_are_survived() {
    let folder = folder();
    let text = "camera = { from = [0, 0, 4] }\nobject = { kind = 'sphere', medium = 'm' }\n\
                [media.m]\nsigma_s = 1\ngrid = { file = 'a.vol' }\n";
    let read = |bytes: &[u8]| {
        fs::write(folder.path().join("a.vol"), bytes).unwrap();
        load_toml_text(text, "a.toml", folder.path(), &[]).is_ok()
    };
    assert!(read(&vol()));
    assert!(feed(&vol(), 15, ROUNDS / 4, read) < ROUNDS / 4);
}

/// A ball of quadrilaterals, ascii or binary.
fn ply(is_binary: bool) -> Vec<u8> {
    let n = 8u8;
    let format = if is_binary { "binary_little_endian" } else { "ascii" };
    let mut bytes = format!(
        "ply\nformat {format} 1.0\ncomment a grid\nelement vertex {}\nproperty float x\nproperty float y\n\
         property float z\nproperty uchar red\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        n * n,
        (n - 1) * (n - 1)
    )
    .into_bytes();
    for i in 0..n * n {
        let (x, y) = (f32::from(i % n), f32::from(i / n));
        if is_binary {
            [x, y, x * y].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
            bytes.push(i);
        } else {
            bytes.extend(format!("{x} {y} {} {i}\n", x * y).bytes());
        }
    }
    for i in 0..(n - 1) * (n - 1) {
        let corner = i / (n - 1) * n + i % (n - 1);
        let corners = [corner, corner + 1, corner + n + 1, corner + n];
        if is_binary {
            bytes.push(4);
            corners.iter().for_each(|index| bytes.extend(i32::from(*index).to_le_bytes()));
        } else {
            bytes.extend(format!("4 {} {} {} {}\n", corners[0], corners[1], corners[2], corners[3]).bytes());
        }
    }
    bytes
}

#[test]
fn damaged_ply_files_are_survived() {
    feed_file(&ply(false), 4, |bytes| mesh_from_bytes(bytes, "a.ply").is_ok());
    feed_file(&ply(true), 5, |bytes| mesh_from_bytes(bytes, "a.ply").is_ok());
}

#[test]
fn damaged_obj_files_are_survived() {
    let mut text = String::from("mtllib a.mtl\no grid\n");
    for i in 0..64 {
        text += &format!("v {} {} 0.5\nvt {} {}\nvn 0 0 1\n", i % 8, i / 8, i % 8, i / 8);
    }
    for i in 0..49 {
        let c = i / 7 * 8 + i % 7 + 1;
        text += &format!("usemtl m{}\nf {c}/{c}/1 {}/{}/1 {}//1 {}\n", i % 3, c + 1, c + 1, c + 9, c - 56);
    }
    feed_file(text.as_bytes(), 6, |bytes| mesh_from_bytes(bytes, "a.obj").is_ok());
}

#[test]
fn damaged_images_are_survived() {
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 16, 16);
    encoder.set_color(png::ColorType::Rgb);
    let pixels: Vec<u8> = (0..16 * 16 * 3).map(|i| (i * 7 % 251) as u8).collect();
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    let mut exr = std::io::Cursor::new(Vec::new());
    use exr::prelude::{Image, SpecificChannels, WritableImage};
    let channels =
        SpecificChannels::rgb(|p: exr::math::Vec2<usize>| (p.0 as f32, p.1 as f32, (p.0 * p.1) as f32));
    Image::from_channels((16, 16), channels).write().non_parallel().to_buffered(&mut exr).unwrap();
    let mut pfm = b"PF\n16 16\n-1.0\n".to_vec();
    (0..16 * 16 * 3).for_each(|i| pfm.extend((i as f32).to_le_bytes()));
    let mut hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 16\n".to_vec();
    for row in 0..16 {
        hdr.extend([2, 2, 0, 16]);
        (0..4).for_each(|channel| hdr.extend([128 + 10, row * 3 + channel, 6, 1, 2, 3, 4, 5, 6]));
    }
    for (name, bytes, seed) in
        [("a.png", &png, 7), ("a.exr", exr.get_ref(), 8), ("a.pfm", &pfm, 9), ("a.hdr", &hdr, 10)]
    {
        feed_file(bytes, seed, |bytes| image_from_bytes(bytes, name).is_ok());
    }
}
