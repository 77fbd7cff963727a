//! JPEG: grey and color, baseline and progressive; decoded by integer arithmetic without SIMD, so to the same bits on
//! every machine.

use super::check_size;
use hyaline_scene::ImageData;
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

/// The markers before coded pixels and after the last; coded pixels hold neither.
const START_OF_SCAN: [u8; 2] = [0xff, 0xda];
const END_OF_IMAGE: [u8; 2] = [0xff, 0xd9];

/// Reads a JPEG; values are 0…1 as encoded.
pub(super) fn read(bytes: &[u8]) -> Result<ImageData, String> {
    let describe = |error: zune_jpeg::errors::DecodeErrors| format!("not a sound JPEG: {error}");
    let options = DecoderOptions::new_safe()
        .set_strict_mode(true)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX))
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(describe)?;
    let info = decoder.info().ok_or("not a sound JPEG: it has no header")?;
    let (width, height) = check_size(u64::from(info.width), u64::from(info.height))?;
    // A block of 64 pixels takes a bit at the least: a header that claims more is not worth its memory.
    let count = width as usize * height as usize;
    if count / 1024 > bytes.len() {
        return Err("not a sound JPEG: it is too short for its size".to_owned());
    }
    // The decoder fills up what is missing at the end; we would rather say that it is.
    let last = |marker: [u8; 2]| bytes.windows(2).rposition(|pair| pair == marker);
    if last(END_OF_IMAGE) < last(START_OF_SCAN) {
        return Err("not a sound JPEG: it ends before its last pixel".to_owned());
    }
    let samples = decoder.decode().map_err(describe)?;
    if samples.len() != 3 * count {
        return Err("not a sound JPEG: pixels are missing".to_owned());
    }
    let pixels = samples.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]].map(|v| f32::from(v) / 255.0));
    Ok(ImageData { width, height, pixels: pixels.collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A baseline JPEG, one row of blocks of 8 x 8 pixels, each of one color per component (0…255).
    ///
    /// Code words of the first table are the four bits of how many bits a difference has; that of the second, a zero
    /// bit, says that a block has nothing but its mean. The quantum of means is 8, of which a mean is an eighth.
    fn encode(components: u8, blocks: &[&[i32]]) -> Vec<u8> {
        let mut bytes = vec![0xff, 0xd8, 0xff, 0xdb, 0, 67, 0];
        bytes.extend([8u8; 64]);
        bytes.extend([0xff, 0xc0, 0, 8 + 3 * components, 8, 0, 8, 0, 8 * blocks.len() as u8, components]);
        (1..=components).for_each(|id| bytes.extend([id, 0x11, 0]));
        bytes.extend([0xff, 0xc4, 0, 28, 0x00, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
        bytes.extend(0..9u8);
        bytes.extend([0xff, 0xc4, 0, 20, 0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
        bytes.extend([0xff, 0xda, 0, 6 + 2 * components, components]);
        (1..=components).for_each(|id| bytes.extend([id, 0x00]));
        bytes.extend([0, 63, 0]);
        let mut bits = String::new();
        let mut before = vec![128; usize::from(components)];
        for block in blocks {
            for (mean, before) in block.iter().zip(&mut before) {
                let difference = mean - *before;
                *before = *mean;
                let length = (32 - difference.unsigned_abs().leading_zeros()) as usize;
                let coded = if difference < 0 { difference + (1 << length) - 1 } else { difference };
                bits += &format!("{length:04b}");
                if length > 0 {
                    bits += &format!("{coded:0length$b}");
                }
                bits.push('0');
            }
        }
        while !bits.len().is_multiple_of(8) {
            bits.push('1');
        }
        for byte in bits.as_bytes().chunks(8) {
            let byte = byte.iter().fold(0, |value, bit| 2 * value + (bit - b'0'));
            bytes.push(byte);
            if byte == 0xff {
                bytes.push(0);
            }
        }
        bytes.extend([0xff, 0xd9]);
        bytes
    }

    #[test]
    fn grey_and_color_are_read_with_their_values() {
        let grey = read(&encode(1, &[&[100], &[255], &[0]])).unwrap();
        assert_eq!((grey.width, grey.height), (24, 8));
        assert_eq!(
            [grey.pixels[0], grey.pixels[15], grey.pixels[7 * 24 + 23]],
            [[100.0 / 255.0; 3], [1.0; 3], [0.0; 3]]
        );
        // JFIF 1.02: R = Y + 1.402 (Cr - 128), G = Y - 0.344136 (Cb - 128) - 0.714136 (Cr - 128), B = Y + 1.772 (Cb - 128).
        let color = read(&encode(3, &[&[120, 90, 170], &[60, 200, 100]])).unwrap();
        for (pixel, expected) in [(0, [178.9, 103.1, 52.7]), (8, [20.8, 55.2, 187.6])] {
            for (got, want) in color.pixels[pixel].iter().zip(expected) {
                assert!((got * 255.0 - want).abs() < 1.5, "{:?} {expected:?}", color.pixels[pixel]);
            }
        }
    }

    #[test]
    fn what_is_cut_or_damaged_is_refused_or_read_but_never_a_panic() {
        let bytes = encode(3, &[&[120, 90, 170], &[60, 200, 100]]);
        for length in 0..bytes.len() - 2 {
            assert!(read(&bytes[..length]).is_err(), "cut at {length} of {}", bytes.len());
        }
        for position in 0..bytes.len() {
            for value in [0, 1, 0x7f, 0x80, 0xd9, 0xff] {
                let mut damaged = bytes.clone();
                damaged[position] = value;
                let _ = read(&damaged);
            }
        }
        let mut huge = bytes;
        let size = huge.windows(2).position(|marker| marker == [0xff, 0xc0]).unwrap() + 5;
        huge[size..size + 4].copy_from_slice(&[0x10, 0, 0x10, 0]);
        assert!(read(&huge).unwrap_err().contains("too short"), "4096 x 4096 pixels of a few bytes");
    }
}
