//! Frames that are carried from one direction to another by the shortest turn, so that neighbors have like frames.

use hyaline_math::{Frame, Vec3};

/// The frame turned so that its normal becomes `n`, unit; any frame about `n` where the turn is all but a half turn.
pub(super) fn turned_frame(frame: &Frame, n: Vec3) -> Frame {
    let cosine = frame.n.dot(n);
    if cosine < -0.999_999 {
        return Frame::from_normal(n);
    }
    // Rodrigues' formula for a vector perpendicular to the old normal.
    let sum = frame.n + n;
    let turned = |v: Vec3| v - sum * (n.dot(v) / (1.0 + cosine));
    Frame { s: turned(frame.s), t: turned(frame.t), n }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_frame_is_orthonormal_and_no_vector_moves_farther_than_the_normal() {
        let directions =
            [Vec3::X, -Vec3::Z, Vec3::new(0.48, -0.6, 0.64), Vec3::new(-0.48, 0.6, -0.64), Vec3::Y];
        for from in directions {
            let frame = Frame::from_normal(from);
            for to in directions {
                let turned = turned_frame(&frame, to);
                assert!((turned.s.cross(turned.t) - to).length() < 1e-5, "{from} {to}");
                assert!((turned.s.length() - 1.0).abs() < 1e-5);
                if from.dot(to) > -0.999 {
                    let moved = (to - from).length() + 1e-5;
                    assert!((turned.s - frame.s).length() <= moved && (turned.t - frame.t).length() <= moved);
                }
            }
        }
    }
}
