//! How dense a medium is, place by place: numbers on a regular grid in a placed unit cube.

use super::majorants::Majorants;
use hyaline_math::{DVec3, Mat3, Transform, Vec3};
use hyaline_spectrum::Spectrum;

/// Densities on a regular grid: trilinear between the centers of its cells, 0 outside of its cube.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    size: [u32; 3],
    density: Vec<f32>,
    albedo: Option<AlbedoGrid>,
    /// World to the unit cube.
    linear: Mat3,
    offset: Vec3,
    majorants: Majorants,
}

/// Scattering albedo by place.
#[derive(Clone, Debug, PartialEq)]
pub struct AlbedoGrid {
    /// Cells along x, y and z.
    pub size: [u32; 3],
    /// Albedo of each cell, 0…1 per lane: x first, then y, then z.
    pub values: Vec<Spectrum>,
}

/// The part of a line that lies in the cube, in the cube's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Inside {
    pub(super) origin: Vec3,
    pub(super) direction: Vec3,
    /// Where the line enters and leaves, in the line's own parameter.
    pub(super) range: [f32; 2],
}

impl Grid {
    /// A grid of densities.
    ///
    /// - `size`: cells along x, y and z, ≥ 1 each.
    /// - `density`: of each cell, ≥ 0 and finite: x first, then y, then z.
    /// - `placement`: unit cube to world.
    ///
    /// # Panics
    /// Where `density` or the albedo does not have as many values as cells.
    pub fn new(size: [u32; 3], density: Vec<f32>, albedo: Option<AlbedoGrid>, placement: &Transform) -> Self {
        assert_eq!(density.len(), cell_count(size), "one density for each cell");
        if let Some(albedo) = &albedo {
            assert_eq!(albedo.values.len(), cell_count(albedo.size), "one albedo for each cell");
        }
        let inverse = placement.inverse();
        let majorants = Majorants::new(size, &density);
        let (linear, offset) = (inverse.linear().as_mat3(), inverse.point(DVec3::ZERO).as_vec3());
        Self { size, density, albedo, linear, offset, majorants }
    }

    /// Density at a point of the world, ≥ 0.
    pub fn density(&self, p: Vec3) -> f32 {
        self.density_in_cube(self.linear * p + self.offset)
    }

    /// Albedo at a point of the world, where the grid has one of its own.
    pub fn albedo(&self, p: Vec3) -> Option<Spectrum> {
        let albedo = self.albedo.as_ref()?;
        let value = |i: usize| albedo.values[i];
        Some(trilinear(albedo.size, self.linear * p + self.offset, value, Spectrum::ZERO))
    }

    /// Whether the albedo is told by place.
    pub fn has_albedo(&self) -> bool {
        self.albedo.is_some()
    }

    /// Densities and their upper bounds along a line.
    pub(super) fn majorants(&self) -> &Majorants {
        &self.majorants
    }

    /// Density at a point of the unit cube.
    pub(super) fn density_in_cube(&self, q: Vec3) -> f32 {
        if q.min_element() < 0.0 || q.max_element() > 1.0 {
            return 0.0;
        }
        trilinear(self.size, q, |i| self.density[i], 0.0)
    }

    /// The part of a line within the cube; `None` where it misses it.
    ///
    /// - `t_max`: end of the line; may be infinite.
    pub(super) fn inside(&self, origin: Vec3, direction: Vec3, t_max: f32) -> Option<Inside> {
        let (origin, direction) = (self.linear * origin + self.offset, self.linear * direction);
        let mut range = [0.0, t_max];
        for axis in 0..3 {
            let (o, d) = (origin[axis], direction[axis]);
            if d == 0.0 {
                if !(0.0..=1.0).contains(&o) {
                    return None;
                }
                continue;
            }
            let (a, b) = (-o / d, (1.0 - o) / d);
            range = [range[0].max(a.min(b)), range[1].min(a.max(b))];
        }
        (range[0] < range[1]).then_some(Inside { origin, direction, range })
    }
}

/// Number of cells of a grid.
fn cell_count(size: [u32; 3]) -> usize {
    size.iter().map(|&n| n as usize).product()
}

/// Value between the centers of the cells about a point of the unit cube.
fn trilinear<T>(size: [u32; 3], q: Vec3, value: impl Fn(usize) -> T, zero: T) -> T
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f32, Output = T>,
{
    let mut cells = [[0_usize; 2]; 3];
    let mut shares = [0.0; 3];
    for axis in 0..3 {
        let x = q[axis] * size[axis] as f32 - 0.5;
        let lowest = x.floor();
        let last = size[axis] as usize - 1;
        let first = if lowest < 0.0 { 0 } else { (lowest as usize).min(last) };
        let second = if lowest < 0.0 { 0 } else { (first + 1).min(last) };
        cells[axis] = [first, second];
        shares[axis] = x - lowest;
    }
    let mut result = zero;
    for corner in 0..8_usize {
        let bit = |axis: usize| corner >> axis & 1;
        let share = |axis: usize| if bit(axis) == 1 { shares[axis] } else { 1.0 - shares[axis] };
        let [x, y, z] = [0, 1, 2].map(|axis| cells[axis][bit(axis)]);
        let index = (z * size[1] as usize + y) * size[0] as usize + x;
        result = result + value(index) * (share(0) * share(1) * share(2));
    }
    result
}
