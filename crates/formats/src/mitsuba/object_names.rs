//! Names of objects and lights, each given once.

use std::collections::{BTreeMap, BTreeSet};

/// The names given so far.
#[derive(Debug, Default)]
pub(super) struct ObjectNames {
    taken: BTreeSet<String>,
    /// The last number added to each wanted name.
    counts: BTreeMap<String, u32>,
}

impl ObjectNames {
    /// A name that nobody has: the wanted one, or that with a number.
    pub(super) fn unique(&mut self, wanted: String) -> String {
        if self.taken.insert(wanted.clone()) {
            return wanted;
        }
        let count = self.counts.entry(wanted.clone()).or_insert(1);
        loop {
            *count += 1;
            let name = format!("{wanted} ({count})");
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_given_once() {
        let mut names = ObjectNames::default();
        let given = ["a", "a (2)", "a", "b", "a"].map(|name| names.unique(name.to_owned()));
        assert_eq!(given, ["a", "a (2)", "a (3)", "b", "a (4)"]);
    }
}
