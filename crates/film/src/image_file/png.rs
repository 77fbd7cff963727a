//! PNG: 8-bit sRGB for looking at.

use super::ImageError;
use crate::image::Image;
use hyaline_spectrum::color::linear_to_srgb8;

/// The content of a PNG file: colors times `exposure`, clipped to 0…1, sRGB encoded and rounded.
pub(super) fn encode(image: &Image, exposure: f32) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.window.width(), image.window.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    let pixels: Vec<u8> = image.rgb.as_flattened().iter().map(|&v| linear_to_srgb8(v * exposure)).collect();
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(&pixels).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

fn failed(error: png::EncodingError) -> ImageError {
    ImageError::Content(format!("the PNG could not be made: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(image: &Image, exposure: f32) -> Vec<u8> {
        let bytes = encode(image, exposure).expect("encoded");
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
        assert_eq!(reader.output_color_type(), (png::ColorType::Rgb, png::BitDepth::Eight));
        let mut pixels = vec![0; reader.output_buffer_size().expect("small")];
        reader.next_frame(&mut pixels).expect("a picture");
        pixels
    }

    #[test]
    fn colors_are_exposed_clipped_and_encoded() {
        let image = Image::new(2, 1, vec![[0.0, 0.107, 0.5], [1e9, -3.0, f32::NAN]]);
        // Twice 0.107 is the linear value of 127.5/255 less a little, and twice 0.5 is white.
        assert_eq!(pixels(&image, 2.0), [0, 127, 255, 255, 0, 0]);
    }

    #[test]
    fn the_same_picture_is_the_same_file() {
        let rgb = (0..1000).map(|i| [i as f32 * 1e-3, 0.5, 1.0 - i as f32 * 1e-3]).collect();
        let image = Image::new(40, 25, rgb);
        assert_eq!(encode(&image, 1.0).expect("encoded"), encode(&image, 1.0).expect("encoded"));
    }
}
