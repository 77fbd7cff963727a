use super::*;

fn texture(kind: TextureKind) -> Texture {
    Texture::new(&TextureDescription::new("t", kind))
}

/// Pixels from the upper left, `width` a row.
fn image(width: u32, values: &[f32]) -> TextureKind {
    let pixels: Vec<[f32; 3]> = values.iter().map(|&v| [v; 3]).collect();
    TextureKind::Image(Arc::new(ImageData { width, height: pixels.len() as u32 / width, pixels }))
}

fn read(values: &[f32], wrap: Wrap, filter: TextureFilter, u: f32) -> f32 {
    let description = TextureDescription {
        wrap,
        filter,
        ..TextureDescription::new("t", image(values.len() as u32, values))
    };
    Texture::new(&description).color(Vec2::new(u, 0.5))[0]
}

#[test]
fn a_checker_alternates_along_both_axes() {
    let t = texture(TextureKind::Checker { even: [1.0; 3], odd: [0.0; 3] });
    assert_eq!(t.color(Vec2::new(0.25, 0.25)), [1.0; 3]);
    assert_eq!(t.color(Vec2::new(0.75, 0.25)), [0.0; 3]);
    assert_eq!(t.color(Vec2::new(0.75, -0.25)), [1.0; 3]);
}

#[test]
fn the_first_row_of_an_image_is_at_the_top() {
    let t = texture(image(2, &[1.0, 1.0, 0.0, 0.0]));
    assert_eq!(t.color(Vec2::new(0.5, 0.75)), [1.0; 3]);
    assert_eq!(t.color(Vec2::new(0.5, 0.25)), [0.0; 3]);
    assert_eq!(t.color(Vec2::new(0.1, 0.5)), [0.5; 3]);
}

#[test]
fn beyond_the_edge_the_image_repeats_or_is_mirrored_or_its_edge_goes_on() {
    let values = [1.0, 2.0, 3.0, 4.0];
    // The centers of eight pixels from two before the image on.
    let centers = [-0.375, -0.125, 0.125, 0.375, 0.625, 0.875, 1.125, 1.375];
    for filter in [TextureFilter::Bilinear, TextureFilter::Nearest] {
        let row = |wrap| centers.map(|u| read(&values, wrap, filter, u));
        assert_eq!(row(Wrap::Repeat), [3.0, 4.0, 1.0, 2.0, 3.0, 4.0, 1.0, 2.0]);
        assert_eq!(row(Wrap::Mirror), [2.0, 1.0, 1.0, 2.0, 3.0, 4.0, 4.0, 3.0]);
        assert_eq!(row(Wrap::Clamp), [1.0, 1.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0]);
    }
}

#[test]
fn edges_are_smooth_where_the_image_goes_on() {
    let read = |wrap, u| read(&[1.0, 2.0, 3.0, 4.0], wrap, TextureFilter::Bilinear, u);
    for u in [0.0, 1.0, -3.0] {
        assert_eq!(read(Wrap::Repeat, u), 2.5, "between the last pixel and the first");
    }
    for wrap in [Wrap::Mirror, Wrap::Clamp] {
        assert_eq!((read(wrap, 0.0), read(wrap, 1.0)), (1.0, 4.0));
    }
    assert_eq!(read(Wrap::Mirror, 2.0), 1.0);
}

#[test]
fn the_nearest_pixel_has_sharp_edges() {
    let read = |u| read(&[1.0, 2.0, 3.0, 4.0], Wrap::Repeat, TextureFilter::Nearest, u);
    assert_eq!([0.249, 0.251, 0.499, 0.501, 0.999, 1.001].map(read), [1.0, 2.0, 2.0, 3.0, 4.0, 1.0]);
}

#[test]
fn coordinates_that_are_no_numbers_read_something() {
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
        for filter in [TextureFilter::Bilinear, TextureFilter::Nearest] {
            for u in [f32::NAN, f32::INFINITY, 3e38, -3e38] {
                read(&[1.0, 2.0, 3.0], wrap, filter, u);
            }
        }
    }
}

#[test]
fn the_gradient_is_that_of_the_picture_on_the_surface() {
    // A ramp that grows by 1 along s, laid out so that s = 2 u + v.
    let values: Vec<f32> = (0..16).map(|i| (i as f32 + 0.5) / 16.0).collect();
    let description = TextureDescription {
        uv_transform: [[2.0, 1.0, 0.1], [0.0, 1.0, 0.0]],
        ..TextureDescription::new("t", image(16, &values))
    };
    let gradient = Texture::new(&description).gradient(Vec2::new(0.1, 0.2));
    assert!((gradient - Vec2::new(2.0, 1.0)).length() < 1e-4, "{gradient}");
}
