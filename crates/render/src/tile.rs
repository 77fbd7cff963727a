//! Tiles: the unit that threads take.

use hyaline_film::Rect;

/// Side of a tile, pixels: small enough to balance, large enough to keep neighbors' rays together.
pub(crate) const SIDE: u32 = 16;

/// Cuts a rectangle into tiles, row by row; those at the right and lower edge may be smaller.
pub(crate) fn tiles(area: Rect) -> Vec<Rect> {
    let starts = |from: u32, to: u32| (from..to).step_by(SIDE as usize);
    starts(area.y0, area.y1)
        .flat_map(|y| starts(area.x0, area.x1).map(move |x| (x, y)))
        .map(|(x, y)| Rect {
            x0: x,
            y0: y,
            x1: x.saturating_add(SIDE).min(area.x1),
            y1: y.saturating_add(SIDE).min(area.y1),
        })
        .collect()
}

/// Parts rows of values over `area` among its tiles: for each tile, in their order, its part of each of its rows.
pub(crate) fn part<T>(area: Rect, values: &mut [T]) -> Vec<Vec<&mut [T]>> {
    let (width, side) = (area.width() as usize, SIDE as usize);
    let mut parts = Vec::new();
    for band in values.chunks_mut(width * side) {
        let mut band_parts: Vec<Vec<&mut [T]>> =
            (0..width.div_ceil(side)).map(|_| Vec::with_capacity(side)).collect();
        for row in band.chunks_mut(width) {
            band_parts.iter_mut().zip(row.chunks_mut(side)).for_each(|(part, piece)| part.push(piece));
        }
        parts.append(&mut band_parts);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_rows_are_those_of_the_tiles() {
        let area = Rect { x0: 5, y0: 3, x1: 50, y1: 36 };
        let mut pixels: Vec<(u32, u32)> = area.pixels().collect();
        let parts = part(area, &mut pixels);
        let tiles = tiles(area);
        assert_eq!(parts.len(), tiles.len());
        for (tile, part) in tiles.into_iter().zip(parts) {
            assert!(part.into_iter().flatten().map(|pixel| *pixel).eq(tile.pixels()));
        }
    }

    #[test]
    fn tiles_cover_every_pixel_once() {
        let area = Rect { x0: 5, y0: 3, x1: 50, y1: 36 };
        let mut seen: Vec<(u32, u32)> = tiles(area).into_iter().flat_map(Rect::pixels).collect();
        seen.sort_by_key(|&(x, y)| (y, x));
        assert!(seen.into_iter().eq(area.pixels()));
    }
}
