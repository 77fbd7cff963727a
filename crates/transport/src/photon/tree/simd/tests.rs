//! Every level against the plain steps, bit for bit.

use super::*;
use crate::photon::tree::{Disc, Region};
use hyaline_math::{Bounds, Vec3};
use hyaline_testkit::Random;

/// All wide steps on random input, as bits.
struct AllSteps<'a> {
    probe: &'a Probe,
    node: &'a Node,
    packet: &'a Packet,
    limit: f32,
}

impl Query for AllSteps<'_> {
    type Output = (Vec<u32>, [u32; 3]);

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Self::Output {
        let (boxes, box_mask) = lanes.box_distances(self.probe, self.node, self.limit);
        let (points, mask) = lanes.point_distances(self.probe, self.packet, self.limit);
        let not_above = lanes.not_above(&points.0, self.limit);
        let (mut front, mut lane_front) = ([0.0; PACKET], [0_u32; PACKET]);
        lanes.compress(&points.0, mask, &mut front);
        lanes.compress(&std::array::from_fn(|lane| lane as u32), mask, &mut lane_front);
        let count = mask.count_ones() as usize;
        let floats = boxes.iter().chain(&points.0).chain(&front[..count]);
        let numbers = floats.map(|x| x.to_bits()).chain(lane_front[..count].iter().copied()).collect();
        (numbers, [box_mask, mask, not_above])
    }
}

fn random_point(random: &mut Random) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| random.uniform_f32()))
}

#[test]
fn all_levels_give_the_same_bits() {
    let mut random = Random::from_seed(5);
    for round in 0..2000 {
        let boxes = (0..round % 9)
            .map(|_| Bounds::from_points([random_point(&mut random), random_point(&mut random)]));
        let node = Node::new(boxes.collect::<Vec<_>>().into_iter());
        let points: Vec<Vec3> = (0..round % 17).map(|_| random_point(&mut random)).collect();
        let packet = Packet::new(points.into_iter());
        let normal = Vec3::from_array(random.direction().map(|x| x as f32));
        let disc = (round % 2 == 0).then_some(Disc { normal, thickness: random.uniform_f32() });
        let region = Region { center: random_point(&mut random), radius: random.uniform_f32(), disc };
        let probe = Probe::new(&region).expect("the region is a place");
        let run = |level| {
            let steps = AllSteps { probe: &probe, node: &node, packet: &packet, limit: probe.limit };
            VerifiedLevel::new(level).run(steps)
        };
        let expected = run(SimdLevel::Scalar);
        for level in SimdLevel::ALL {
            assert_eq!(run(level), expected, "{level:?}");
        }
    }
}
