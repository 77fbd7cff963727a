//! What a film is a picture of.

use crate::error::FilmError;
use crate::rect::Rect;

/// Largest width and height of a frame, pixels.
pub(crate) const MAX_SIDE: u32 = 1 << 16;

/// One thing that a picture depends on, by name: the scene's content, the integrator, a setting, the algorithm version.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DigestPart {
    /// What it is, in words that a user understands.
    pub name: String,
    /// Its value, or a hash of it.
    pub value: String,
}

/// All that a picture depends on. Films with equal headers hold passes of one picture and can be merged.
///
/// Nothing here may depend on the length of a run, on the command that started it or on the machine: the same passes
/// give the same bytes however they were made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilmHeader {
    /// Width of the full frame, pixels, 1…65536.
    pub width: u32,
    /// Height of the full frame, pixels, 1…65536.
    pub height: u32,
    /// The part of the frame that the film holds; the whole frame, mostly.
    pub crop: Rect,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Everything else, in a fixed order.
    pub parts: Vec<DigestPart>,
}

impl FilmHeader {
    /// Identifies the picture: 64 hexadecimal digits, equal for equal headers only.
    pub fn digest(&self) -> String {
        blake3::hash(&self.to_bytes()).to_hex().to_string()
    }

    /// Whether a film can be of this frame.
    ///
    /// # Errors
    /// If the frame is empty or beyond 65536 pixels, or the crop is empty or not inside it.
    pub fn check(&self) -> Result<(), FilmError> {
        let Rect { x0, y0, x1, y1 } = self.crop;
        if !(1..=MAX_SIDE).contains(&self.width) || !(1..=MAX_SIDE).contains(&self.height) {
            return Err(FilmError::Frame("the picture must be 1 to 65536 pixels wide and high"));
        }
        if x0 >= x1 || y0 >= y1 {
            return Err(FilmError::Frame("the crop holds no pixel"));
        }
        if x1 > self.width || y1 > self.height {
            return Err(FilmError::Frame("the crop reaches beyond the picture"));
        }
        Ok(())
    }

    /// That `other` is of the same picture.
    ///
    /// # Errors
    /// The first difference, by name, if it isn't.
    pub fn check_same(&self, other: &Self) -> Result<(), FilmError> {
        let (ours, theirs) = (self.named_values(), other.named_values());
        for i in 0..ours.len().max(theirs.len()) {
            match (ours.get(i), theirs.get(i)) {
                (Some((name, a)), Some((other_name, b))) if name == other_name => {
                    if a != b {
                        return Err(mismatch(name, a, b));
                    }
                }
                (Some((name, value)), _) => return Err(mismatch(name, value, "not there")),
                (None, Some((name, value))) => return Err(mismatch(name, "not there", value)),
                (None, None) => {}
            }
        }
        Ok(())
    }

    /// The header as the film file holds it.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let Rect { x0, y0, x1, y1 } = self.crop;
        let mut bytes = Vec::new();
        for number in [self.width, self.height, x0, y0, x1, y1] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(self.seed.to_le_bytes());
        bytes.extend((self.parts.len() as u32).to_le_bytes());
        for text in self.parts.iter().flat_map(|part| [&part.name, &part.value]) {
            bytes.extend((text.len() as u32).to_le_bytes());
            bytes.extend(text.as_bytes());
        }
        bytes
    }

    fn named_values(&self) -> Vec<(&str, String)> {
        let Rect { x0, y0, x1, y1 } = self.crop;
        let mut values = vec![
            ("size", format!("{}x{}", self.width, self.height)),
            ("crop", format!("{x0},{y0},{x1},{y1}")),
            ("seed", self.seed.to_string()),
        ];
        values.extend(self.parts.iter().map(|part| (part.name.as_str(), part.value.clone())));
        values
    }
}

fn mismatch(what: &str, ours: &str, theirs: &str) -> FilmError {
    FilmError::Mismatch { what: what.to_owned(), ours: ours.to_owned(), theirs: theirs.to_owned() }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Header of a film of one setting.
    pub(crate) fn header(width: u32, height: u32) -> FilmHeader {
        let crop = Rect { x0: 0, y0: 0, x1: width, y1: height };
        let part = |name: &str, value: &str| DigestPart { name: name.to_owned(), value: value.to_owned() };
        let parts = vec![part("integrator", "path"), part("scene", "a1b2c3")];
        FilmHeader { width, height, crop, seed: 1, parts }
    }

    #[test]
    fn the_first_difference_is_named() {
        let ours = header(4, 3);
        ours.check_same(&ours.clone()).expect("same");
        let message = |theirs: &FilmHeader| {
            assert_ne!(ours.digest(), theirs.digest());
            ours.check_same(theirs).expect_err("different").to_string()
        };
        let mut theirs = ours.clone();
        theirs.parts[1].value = "d4".to_owned();
        assert!(message(&theirs).contains("scene is a1b2c3 in one and d4 in the other"));
        theirs.seed = 2;
        assert!(message(&theirs).contains("seed is 1 in one and 2 in the other"));
        theirs = ours.clone();
        theirs.parts.pop();
        assert!(message(&theirs).contains("scene is a1b2c3 in one and not there in the other"));
        assert!(theirs.check_same(&ours).is_err());
    }

    #[test]
    fn moving_text_between_parts_changes_the_digest() {
        let (a, mut b) = (header(4, 3), header(4, 3));
        b.parts[0] = DigestPart { name: "integratorp".to_owned(), value: "ath".to_owned() };
        assert_ne!(a.digest(), b.digest());
    }

    #[test]
    fn impossible_frames_are_refused() {
        header(4, 3).check().expect("possible");
        assert!(header(0, 3).check().is_err());
        assert!(header(MAX_SIDE + 1, 3).check().is_err());
        for crop in [
            Rect { x0: 2, y0: 0, x1: 1, y1: 3 },
            Rect { x0: 0, y0: 0, x1: 5, y1: 3 },
            Rect { x0: 0, y0: 1, x1: 4, y1: 1 },
        ] {
            assert!(FilmHeader { crop, ..header(4, 3) }.check().is_err());
        }
    }
}
