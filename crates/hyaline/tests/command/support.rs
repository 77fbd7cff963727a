//! What the tests of the command share: a folder of its own for each, a small scene, and the command itself.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use tempfile::TempDir;

/// A glass ball on a checkered floor under a lamp and a faint sky.
pub(crate) const SCENE: &str = r#"format_version = 1

[film]
size = [24, 18]

[camera]
from = [0, 0.5, 2]
to = [0, 0.25, 0]
fov = 40

[media.glass]
ior = 1.5
color = { rgb = [0.6, 0.95, 0.8], at = "50 cm" }

[[object]]
name = "ball"
kind = "sphere"
center = [0, 0.3, 0]
radius = 0.3
medium = "glass"

[[object]]
name = "floor"
kind = "rectangle"
center = [0, 0, 0]
size = [4, 4]
normal = [0, 1, 0]
material = { kind = "matte", color = [0.7, 0.68, 0.65] }

[[light]]
name = "lamp"
kind = "disc"
center = [0.5, 2, 0.5]
radius = 0.3
to = [0, 0, 0]
radiance = [20, 19, 17]

[[light]]
name = "sky"
kind = "environment"
radiance = [0.2, 0.25, 0.3]
"#;

/// A folder that goes away with the test, and the command run in it.
pub(crate) struct Workshop {
    folder: TempDir,
}

impl Workshop {
    /// A folder with `scene.toml` in it.
    pub(crate) fn new() -> Self {
        let workshop = Self { folder: tempfile::tempdir().expect("a folder for the test") };
        workshop.write("scene.toml", SCENE);
        workshop
    }

    /// Path of a file in the folder.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file into the folder.
    pub(crate) fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("the file can be written");
    }

    /// Bytes of a file in the folder.
    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Fails where two files differ, telling where and not all that is in them.
    pub(crate) fn assert_same(&self, a: &str, b: &str) {
        let (bytes_a, bytes_b) = (self.bytes(a), self.bytes(b));
        let difference = bytes_a.iter().zip(&bytes_b).position(|(a, b)| a != b);
        assert_eq!(difference, None, "first difference of {a} and {b}");
        assert_eq!(bytes_a.len(), bytes_b.len(), "lengths of {a} and {b}");
    }

    /// Names of all files in the folder, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = self.folder.path().read_dir().expect("the folder can be read");
        let mut names: Vec<String> = entries
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// Runs the command with these words, parted by blanks.
    pub(crate) fn run(&self, words: &str) -> Run {
        Run::from(self.command(words).output().expect("the command runs"))
    }

    /// Runs the command and expects it to succeed.
    pub(crate) fn succeed(&self, words: &str) -> Run {
        let run = self.run(words);
        assert_eq!(run.code, Some(0), "hyaline {words}\n{}", run.stderr);
        run
    }

    /// Starts the command.
    pub(crate) fn start(&self, words: &str) -> Child {
        self.command(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the command starts")
    }

    fn command(&self, words: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hyaline"));
        command.args(words.split_whitespace()).current_dir(self.folder.path()).stdin(Stdio::null());
        command
    }
}

/// What a run of the command left.
#[derive(Debug)]
pub(crate) struct Run {
    /// Exit code; `None` after a signal that ended it.
    pub(crate) code: Option<i32>,
    /// Results.
    pub(crate) stdout: String,
    /// Messages.
    pub(crate) stderr: String,
}

impl Run {
    /// First line on stderr.
    pub(crate) fn first_line(&self) -> &str {
        self.stderr.lines().next().unwrap_or_default()
    }

    /// The last line on stdout as JSON.
    pub(crate) fn json(&self) -> serde_json::Value {
        let line = self.stdout.lines().last().unwrap_or_default();
        serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}"))
    }
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }
}

/// Width, height and colors of a PFM picture, rows from the top.
pub(crate) fn read_pfm(path: &Path) -> (usize, usize, Vec<[f32; 3]>) {
    let bytes = std::fs::read(path).expect("the picture is there");
    let mut parts = bytes.splitn(4, |byte| *byte == b'\n');
    let mut line = || String::from_utf8_lossy(parts.next().expect("a header line")).into_owned();
    assert_eq!(line(), "PF");
    let size = line();
    let (width, height) = size.split_once(' ').expect("two numbers");
    let (width, height): (usize, usize) = (width.parse().unwrap(), height.parse().unwrap());
    let scale: f32 = line().parse().unwrap();
    let number = |b: &[u8]| {
        let b = [b[0], b[1], b[2], b[3]];
        if scale < 0.0 { f32::from_le_bytes(b) } else { f32::from_be_bytes(b) }
    };
    let data = parts.next().expect("pixels");
    let colors: Vec<[f32; 3]> =
        data.chunks_exact(12).map(|c| [number(&c[0..4]), number(&c[4..8]), number(&c[8..12])]).collect();
    assert_eq!(colors.len(), width * height);
    // PFM stores the lowest row first.
    (width, height, colors.chunks_exact(width).rev().flatten().copied().collect())
}
