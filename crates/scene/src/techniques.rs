//! What `path` and `merging` do, part by part.

use serde::Serialize;

/// Which parts of `path` and `merging` are at work: all of them, but to see what each is worth.
///
/// Hits and samples that are off count nothing where another way makes the same path, and all where none does. So pictures
/// keep their mean whatever is off, but for what `shrinking` is there to take away.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Techniques {
    /// Paths that come to a light by themselves.
    pub hits: bool,
    /// Shadow rays to places on lights.
    pub sampling: bool,
    /// Photons that are merged, in `merging` alone; none is sent for it where this is off.
    pub merging: bool,
    /// At the first polished surfaces both ways are gone in `merging`, and one of the faint ways as well in `path`.
    pub splitting: bool,
    /// More looks through glass where lamps are seen as glints smaller than a pixel, in `merging` alone; nothing without
    /// splitting.
    pub glints: bool,
    /// Photons are aimed at what is polished, by projection maps.
    pub projection: bool,
    /// Photons are sent where light has been found before; `path` asks for light where photons have come from, and goes on
    /// toward what they have lit.
    pub guiding: bool,
    /// Photons that are aimed at nothing, where they pay.
    pub broad: bool,
    /// The radius of photons shrinks from pass to pass; else their blur stays.
    pub shrinking: bool,
}

/// Where a part is switched off.
type Switch = fn(&mut Techniques) -> &mut bool;

/// All parts, by the names they go by in scene files.
const PARTS: [(&str, Switch); 9] = [
    ("hits", |all| &mut all.hits),
    ("samples", |all| &mut all.sampling),
    ("photons", |all| &mut all.merging),
    ("splitting", |all| &mut all.splitting),
    ("glints", |all| &mut all.glints),
    ("projection", |all| &mut all.projection),
    ("guide", |all| &mut all.guiding),
    ("broad-photons", |all| &mut all.broad),
    ("shrinking", |all| &mut all.shrinking),
];

impl Default for Techniques {
    fn default() -> Self {
        Self {
            hits: true,
            sampling: true,
            merging: true,
            splitting: true,
            glints: true,
            projection: true,
            guiding: true,
            broad: true,
            shrinking: true,
        }
    }
}

impl Techniques {
    /// Names of all parts.
    pub fn names() -> impl Iterator<Item = &'static str> {
        PARTS.iter().map(|(name, _)| *name)
    }

    /// Switches a part off; returns whether there is one of this name.
    pub fn leave_out(&mut self, name: &str) -> bool {
        let part = PARTS.iter().find(|(known, _)| *known == name);
        part.inspect(|(_, switch)| *switch(self) = false).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_has_a_name_of_its_own() {
        for name in Techniques::names() {
            let mut less = Techniques::default();
            assert!(less.leave_out(name));
            assert_ne!(less, Techniques::default());
            assert!(Techniques::names().filter(|other| *other != name).all(|other| {
                let mut other_less = Techniques::default();
                other_less.leave_out(other) && other_less != less
            }));
        }
        assert!(!Techniques::default().leave_out("luck"));
    }
}
