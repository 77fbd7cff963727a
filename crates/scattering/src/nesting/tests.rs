//! Walks along a line through random stacks of bodies and sheets, against a direct look at each gap.

use super::*;
use crate::Medium;
use hyaline_testkit::Random;

const AIR: MediumId = MediumId(0);

/// Bodies and sheets on a line, on whole coordinates.
struct Line {
    boundaries: Boundaries,
    /// Surfaces as a walk towards +t meets them, in order of t.
    surfaces: Vec<(i32, ObjectId, Side)>,
    /// Medium outside all solids before the first and after each sheet: (from this t on, medium).
    bases: Vec<(i32, MediumId)>,
}

/// What a walk sees: where, from what, to what, whose finish.
type Seen = (i32, MediumId, MediumId, ObjectId);

fn below(random: &mut Random, n: u64) -> u64 {
    random.bits() % n
}

impl Line {
    /// Up to six solids of up to three shells each, few coordinates and priorities, so that much coincides.
    fn random(random: &mut Random, sheet_count: u64) -> Self {
        let mut line =
            Self { boundaries: Boundaries::default(), surfaces: Vec::new(), bases: vec![(i32::MIN, AIR)] };
        for _ in 0..=below(random, 6) {
            let medium = MediumId(below(random, 5) as u32);
            let priority = below(random, 3) as i32;
            let object = line.add(BoundaryKind::Solid { medium, priority });
            line.add_shells(random, object);
        }
        let mut ts: Vec<i32> = (0..sheet_count).map(|_| below(random, 24) as i32).collect();
        ts.sort_unstable();
        for t in ts {
            line.add_sheet(random, t);
        }
        line.shuffle(random);
        line
    }

    fn add(&mut self, kind: BoundaryKind) -> ObjectId {
        self.boundaries.kinds.push(kind);
        ObjectId(self.boundaries.kinds.len() as u32 - 1)
    }

    /// Intervals that may overlap, nest or touch, but don't begin or end together: those would count once.
    fn add_shells(&mut self, random: &mut Random, object: ObjectId) {
        let (mut starts, mut ends) = (Vec::new(), Vec::new());
        for _ in 0..=below(random, 3) {
            let start = below(random, 20) as i32;
            let end = start + 1 + below(random, 8) as i32;
            if !starts.contains(&start) && !ends.contains(&end) {
                starts.push(start);
                ends.push(end);
                self.surfaces.push((start, object, Side::Entering));
                self.surfaces.push((end, object, Side::Leaving));
            }
        }
    }

    fn add_sheet(&mut self, random: &mut Random, t: i32) {
        let near = self.base_at(t);
        let far = MediumId(below(random, 4) as u32);
        let (kind, side) = if random.uniform() < 0.5 {
            (BoundaryKind::Interface { outside: near, inside: far }, Side::Entering)
        } else {
            (BoundaryKind::Interface { outside: far, inside: near }, Side::Leaving)
        };
        let object = self.add(kind);
        self.surfaces.push((t, object, side));
        self.bases.push((t, far));
    }

    /// Orders the surfaces by t; those at the same t in any order, and some of them reported twice.
    fn shuffle(&mut self, random: &mut Random) {
        let mut keyed: Vec<_> = self.surfaces.iter().map(|&s| (s.0, random.bits(), s)).collect();
        for i in 0..keyed.len() {
            if random.uniform() < 0.1 {
                keyed.push((keyed[i].0, random.bits(), keyed[i].2));
            }
        }
        keyed.sort_unstable_by_key(|k| (k.0, k.1));
        self.surfaces = keyed.into_iter().map(|k| k.2).collect();
    }

    /// Medium of the last sheet at or before `t`.
    fn base_at(&self, t: i32) -> MediumId {
        self.bases.iter().rfind(|base| base.0 <= t).map_or(AIR, |base| base.1)
    }

    /// The solid and the medium in the gap (t, t + 1), without any walking.
    fn gap(&self, t: i32) -> (Option<ObjectId>, MediumId) {
        let unique: std::collections::BTreeSet<_> = self
            .surfaces
            .iter()
            .map(|&(at, object, side)| (at, object, side == Side::Entering))
            .filter(|surface| surface.0 <= t)
            .collect();
        let depth = |object: ObjectId| -> i32 {
            unique.iter().filter(|s| s.1 == object).map(|s| if s.2 { 1 } else { -1 }).sum()
        };
        let objects = (0..self.boundaries.kinds.len() as u32).map(ObjectId);
        let solids = objects.filter_map(|object| match self.boundaries.of(object) {
            BoundaryKind::Solid { medium, priority } if depth(object) > 0 => Some((priority, object, medium)),
            _ => None,
        });
        match solids.max() {
            Some((_, object, medium)) => (Some(object), medium),
            None => (None, self.base_at(t)),
        }
    }

    fn walk(&self, direction: Side) -> Vec<Seen> {
        let mut surfaces = self.surfaces.clone();
        let mut base = AIR;
        if direction == Side::Leaving {
            surfaces.reverse();
            surfaces.iter_mut().for_each(|s| s.2 = s.2.reversed());
            base = self.base_at(i32::MAX);
        }
        let mut set = MediumSet::new(base);
        let mut seen = Vec::new();
        for group in surfaces.chunk_by(|a, b| a.0 == b.0) {
            let hits: Vec<SurfaceCrossing> = group.iter().map(|s| (s.1, s.2)).collect();
            let mut refuse = |object| panic!("{object:?} was never entered");
            match set.crossing(&self.boundaries, &hits, &mut refuse) {
                Crossing::Hidden => {}
                Crossing::Boundary { from, to, owner } => {
                    assert_eq!(set.active(), from, "a path is in the medium that the boundary names");
                    seen.push((group[0].0, from, to, owner));
                }
            }
            set.commit(&self.boundaries, &hits);
            let t = if direction == Side::Leaving { group[0].0 - 1 } else { group[0].0 };
            assert_eq!(set.active(), self.gap(t).1, "after {t}");
        }
        seen
    }

    /// The same list by looking at both sides of each place where something is.
    fn direct(&self) -> Vec<(i32, MediumId, MediumId)> {
        let mut seen = Vec::new();
        for t in 0..40 {
            let (near, far) = (self.gap(t - 1), self.gap(t));
            let has_sheet = self
                .surfaces
                .iter()
                .any(|s| s.0 == t && matches!(self.boundaries.of(s.1), BoundaryKind::Interface { .. }));
            if near.0 != far.0 || (near.0.is_none() && has_sheet) {
                seen.push((t, near.1, far.1));
            }
        }
        seen
    }
}

fn without_owner(seen: &[Seen]) -> Vec<(i32, MediumId, MediumId)> {
    seen.iter().map(|&(t, from, to, _)| (t, from, to)).collect()
}

fn ignore() -> impl FnMut(ObjectId) {
    |_| {}
}

fn check_random_lines(seed: u64, sheet_count: u64) {
    let mut random = Random::from_seed(seed);
    let mut boundary_count = 0;
    for _ in 0..5000 {
        let line = Line::random(&mut random, sheet_count);
        let forward = line.walk(Side::Entering);
        let mut backward = line.walk(Side::Leaving);
        backward.reverse();
        let turned: Vec<Seen> = backward.into_iter().map(|(t, from, to, o)| (t, to, from, o)).collect();
        assert_eq!(forward, turned);
        assert_eq!(without_owner(&forward), line.direct());
        boundary_count += forward.len();
    }
    assert!(boundary_count > 12_000, "only {boundary_count} boundaries were looked at");
}

#[test]
fn overlapping_solids_look_the_same_from_both_ends_and_to_a_direct_look() {
    check_random_lines(1, 0);
}

#[test]
fn solids_among_sheets_look_the_same_from_both_ends_and_to_a_direct_look() {
    check_random_lines(2, 2);
    check_random_lines(3, 6);
}

const GLASS: MediumId = MediumId(1);
const WATER: MediumId = MediumId(2);

fn glass_and_water(glass_priority: i32, water_priority: i32) -> Boundaries {
    Boundaries::new(vec![
        BoundaryKind::Solid { medium: GLASS, priority: glass_priority },
        BoundaryKind::Solid { medium: WATER, priority: water_priority },
        BoundaryKind::Interface { outside: AIR, inside: WATER },
        BoundaryKind::Interface { outside: AIR, inside: GLASS },
        BoundaryKind::None,
    ])
}

const GLASS_BODY: ObjectId = ObjectId(0);
const WATER_BODY: ObjectId = ObjectId(1);
const WATER_SHEET: ObjectId = ObjectId(2);
const GLASS_SHEET: ObjectId = ObjectId(3);
const TABLE: ObjectId = ObjectId(4);

use Side::{Entering, Leaving};

#[test]
fn priority_decides_and_the_object_id_among_equals() {
    for (glass, water, top) in [(1, 0, GLASS), (0, 1, WATER), (0, 0, WATER)] {
        let table = glass_and_water(glass, water);
        for order in [[GLASS_BODY, WATER_BODY], [WATER_BODY, GLASS_BODY]] {
            let mut set = MediumSet::new(AIR);
            order.iter().for_each(|&object| set.enter(&table, object));
            assert_eq!(set.active(), top);
        }
    }
}

#[test]
fn liquid_that_reaches_into_the_wall_ends_at_the_wall() {
    let table = glass_and_water(1, 0);
    let mut set = MediumSet::new(AIR);
    let mut seen = Vec::new();
    // Into the wall, into the water within it, out of the wall.
    for hit in [(GLASS_BODY, Entering), (WATER_BODY, Entering), (GLASS_BODY, Leaving), (WATER_BODY, Leaving)]
    {
        seen.push(set.crossing(&table, &[hit], &mut ignore()));
        set.commit(&table, &[hit]);
    }
    let boundary = |from, to, owner| Crossing::Boundary { from, to, owner };
    assert_eq!(
        seen,
        [
            boundary(AIR, GLASS, GLASS_BODY),
            Crossing::Hidden,
            boundary(GLASS, WATER, GLASS_BODY),
            boundary(WATER, AIR, WATER_BODY),
        ]
    );
}

#[test]
fn a_solid_left_but_never_entered_is_reported_and_was_there_all_along() {
    let table = glass_and_water(0, 0);
    let mut set = MediumSet::new(AIR);
    let mut reported = Vec::new();
    let hit = [(GLASS_BODY, Leaving)];
    let crossing = set.crossing(&table, &hit, &mut |object| reported.push(object));
    assert_eq!(crossing, Crossing::Boundary { from: GLASS, to: AIR, owner: GLASS_BODY });
    assert_eq!(set.active(), GLASS, "a reflected path stays in the glass");
    // It meets the wall again, and this time has been inside.
    set.crossing(&table, &hit, &mut |object| reported.push(object));
    assert_eq!(reported, [GLASS_BODY]);
    set.commit(&table, &hit);
    assert_eq!(set, MediumSet::new(AIR));
}

#[test]
fn a_solid_entered_twice_is_left_at_the_second_leaving() {
    let table = glass_and_water(0, 0);
    let mut set = MediumSet::new(AIR);
    for (side, active) in [(Entering, GLASS), (Entering, GLASS), (Leaving, GLASS), (Leaving, AIR)] {
        set.crossing(&table, &[(GLASS_BODY, side)], &mut |object| panic!("{object:?} was entered"));
        set.commit(&table, &[(GLASS_BODY, side)]);
        assert_eq!(set.active(), active);
    }
}

#[test]
fn an_edge_reported_by_both_faces_counts_once_and_a_grazed_edge_not_at_all() {
    let table = glass_and_water(0, 0);
    let mut set = MediumSet::new(AIR);
    let twice = [(GLASS_BODY, Entering), (GLASS_BODY, Entering)];
    let grazed = [(GLASS_BODY, Entering), (GLASS_BODY, Leaving)];
    assert_eq!(set.crossing(&table, &grazed, &mut ignore()), Crossing::Hidden);
    set.commit(&table, &grazed);
    assert_eq!(set, MediumSet::new(AIR));
    set.commit(&table, &twice);
    set.commit(&table, &[(GLASS_BODY, Leaving)]);
    assert_eq!(set, MediumSet::new(AIR));
}

#[test]
fn a_sheet_names_both_sides_whatever_the_base_was() {
    let table = glass_and_water(0, 0);
    let mut set = MediumSet::new(GLASS);
    let crossing = set.crossing(&table, &[(WATER_SHEET, Leaving)], &mut ignore());
    assert_eq!(crossing, Crossing::Boundary { from: WATER, to: AIR, owner: WATER_SHEET });
    set.commit(&table, &[(WATER_SHEET, Leaving)]);
    assert_eq!(set.active(), AIR);
}

#[test]
fn a_sheet_within_a_solid_is_hidden_but_changes_what_is_outside() {
    let table = glass_and_water(0, 0);
    let mut set = MediumSet::new(AIR);
    set.enter(&table, GLASS_BODY);
    let hit = [(WATER_SHEET, Entering)];
    assert_eq!(set.crossing(&table, &hit, &mut ignore()), Crossing::Hidden);
    set.commit(&table, &hit);
    assert_eq!(set.active(), GLASS);
    set.commit(&table, &[(GLASS_BODY, Leaving)]);
    assert_eq!(set.active(), WATER);
}

#[test]
fn touching_sheets_join_to_one_boundary() {
    // The inner wall of a glass and the water's own surface, each modelled against air.
    let table = glass_and_water(0, 0);
    for order in
        [[(GLASS_SHEET, Leaving), (WATER_SHEET, Entering)], [(WATER_SHEET, Entering), (GLASS_SHEET, Leaving)]]
    {
        let mut set = MediumSet::new(GLASS);
        let crossing = set.crossing(&table, &order, &mut ignore());
        assert_eq!(crossing, Crossing::Boundary { from: GLASS, to: WATER, owner: GLASS_SHEET });
        set.commit(&table, &order);
        assert_eq!(set.active(), WATER);
        let back = order.map(|(object, side)| (object, side.reversed()));
        let crossing = set.crossing(&table, &back, &mut ignore());
        assert_eq!(crossing, Crossing::Boundary { from: WATER, to: GLASS, owner: GLASS_SHEET });
    }
}

#[test]
fn sheets_that_contradict_each_other_still_look_alike_from_both_sides() {
    // Both say that air is above them and their own medium below.
    let table = glass_and_water(0, 0);
    let hits = [(WATER_SHEET, Entering), (GLASS_SHEET, Entering)];
    let down = MediumSet::new(AIR).crossing(&table, &hits, &mut ignore());
    let up = MediumSet::new(GLASS).crossing(&table, &hits.map(|(o, s)| (o, s.reversed())), &mut ignore());
    assert_eq!(down, Crossing::Boundary { from: AIR, to: GLASS, owner: GLASS_SHEET });
    assert_eq!(up, Crossing::Boundary { from: GLASS, to: AIR, owner: GLASS_SHEET });
}

#[test]
fn a_table_under_the_glass_is_seen_through_its_base() {
    let table = glass_and_water(0, 0);
    let mut set = MediumSet::new(AIR);
    set.enter(&table, GLASS_BODY);
    let hits = [(GLASS_BODY, Leaving), (TABLE, Entering)];
    let crossing = set.crossing(&table, &hits, &mut ignore());
    assert_eq!(crossing, Crossing::Boundary { from: GLASS, to: AIR, owner: TABLE });
    let crossing = set.crossing(&table, &[(TABLE, Entering)], &mut ignore());
    assert_eq!(crossing, Crossing::Boundary { from: GLASS, to: GLASS, owner: TABLE });
}

#[test]
fn objects_beyond_the_table_bound_nothing() {
    let crossing =
        MediumSet::new(AIR).crossing(&Boundaries::default(), &[(ObjectId(7), Leaving)], &mut ignore());
    assert_eq!(crossing, Crossing::Boundary { from: AIR, to: AIR, owner: ObjectId(7) });
}

#[test]
fn index_matching_compares_the_indices_and_not_the_names() {
    let media = [Medium::VACUUM, Medium::clear(1.0), Medium::clear(1.5)];
    let boundary = |to| Crossing::Boundary { from: AIR, to, owner: GLASS_BODY };
    assert!(boundary(MediumId(1)).is_index_matched(&media));
    assert!(!boundary(MediumId(2)).is_index_matched(&media));
    assert!(Crossing::Hidden.is_index_matched(&media));
}
