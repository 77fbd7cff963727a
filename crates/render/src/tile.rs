//! Tiles: the unit that threads take.

use hyaline_film::Rect;

/// Side of a tile, pixels: small enough to balance, large enough to keep neighbors' rays together.
const SIDE: u32 = 16;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_every_pixel_once() {
        let area = Rect { x0: 5, y0: 3, x1: 50, y1: 36 };
        let mut seen: Vec<(u32, u32)> = tiles(area).into_iter().flat_map(Rect::pixels).collect();
        seen.sort_by_key(|&(x, y)| (y, x));
        assert!(seen.into_iter().eq(area.pixels()));
    }
}
