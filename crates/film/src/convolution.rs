//! Separable filters on planes of numbers; pixels beyond the border repeat it.

/// One number per pixel.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plane {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Row by row.
    pub(crate) values: Vec<f64>,
}

impl Plane {
    /// All 0.
    pub(crate) fn black(width: usize, height: usize) -> Self {
        Self { width, height, values: vec![0.0; width * height] }
    }

    /// The plane filtered by `along_x` in the rows and `along_y` in the columns.
    pub(crate) fn convolved(&self, along_x: &Kernel, along_y: &Kernel) -> Self {
        let mut rows = Self::black(self.width, self.height);
        for (row, source) in
            rows.values.chunks_mut(self.width.max(1)).zip(self.values.chunks(self.width.max(1)))
        {
            for (x, value) in row.iter_mut().enumerate() {
                *value = along_x.taps(x, self.width).map(|(x, weight)| weight * source[x]).sum();
            }
        }
        let mut result = Self::black(self.width, self.height);
        for (y, row) in result.values.chunks_mut(self.width.max(1)).enumerate() {
            // Whole rows at a time, which is how they lie in memory.
            for (source_y, weight) in along_y.taps(y, self.height) {
                let source = &rows.values[source_y * self.width..][..self.width];
                row.iter_mut().zip(source).for_each(|(value, source)| *value += weight * source);
            }
        }
        result
    }
}

/// Weights of the neighbors -radius…radius.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Kernel {
    radius: usize,
    weights: Vec<f64>,
}

impl Kernel {
    /// The kernel with the weight `f(x)` at the distance x, in pixels.
    pub(crate) fn new(radius: usize, f: impl Fn(f64) -> f64) -> Self {
        let weights = (0..=2 * radius).map(|i| f(i as f64 - radius as f64)).collect();
        Self { radius, weights }
    }

    /// Sum of the weights.
    pub(crate) fn sum(&self) -> f64 {
        self.weights.iter().sum()
    }

    /// The kernel scaled to the sum 1.
    pub(crate) fn normalized(&self) -> Self {
        let sum = self.sum();
        self.map(|weight| weight / sum)
    }

    /// The positive weights scaled to the sum 1, the negative ones to -1.
    pub(crate) fn sides_normalized(&self) -> Self {
        let positive: f64 = self.weights.iter().filter(|&&weight| weight > 0.0).sum();
        let negative: f64 = -self.weights.iter().filter(|&&weight| weight < 0.0).sum::<f64>();
        self.map(|weight| if weight > 0.0 { weight / positive } else { weight / negative })
    }

    fn map(&self, f: impl Fn(f64) -> f64) -> Self {
        Self { radius: self.radius, weights: self.weights.iter().map(|&weight| f(weight)).collect() }
    }

    /// Index and weight of every neighbor of `center` among `count`.
    fn taps(&self, center: usize, count: usize) -> impl Iterator<Item = (usize, f64)> {
        let index = move |i: usize| (center + i).saturating_sub(self.radius).min(count - 1);
        self.weights.iter().enumerate().map(move |(i, &weight)| (index(i), weight))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_are_repeated() {
        let plane = Plane { width: 3, height: 1, values: vec![1.0, 2.0, 4.0] };
        let mean = Kernel::new(1, |_| 1.0).normalized();
        let blurred = plane.convolved(&mean, &mean);
        for (value, expected) in blurred.values.iter().zip([4.0 / 3.0, 7.0 / 3.0, 10.0 / 3.0]) {
            assert!((value - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn rows_and_columns_are_filtered_separately() {
        let mut plane = Plane::black(5, 5);
        plane.values[12] = 1.0;
        let along_x = Kernel::new(1, |x| x + 2.0);
        let along_y = Kernel::new(1, |y| 1.0 + (y == 1.0) as u8 as f64);
        let result = plane.convolved(&along_x, &along_y);
        // The pixel left of the spike sees it on its right, at +1.
        assert_eq!((result.values[11], result.values[13], result.values[7]), (3.0, 1.0, 4.0));
    }

    #[test]
    fn sides_of_a_derivative_add_up_to_one_each() {
        let kernel = Kernel::new(2, |x| -x).sides_normalized();
        assert_eq!(kernel.weights, [2.0 / 3.0, 1.0 / 3.0, 0.0, -1.0 / 3.0, -2.0 / 3.0]);
    }
}
