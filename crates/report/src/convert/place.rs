//! Numbers, directions and frames, as other programs read them.

use kutzbach_closure::Rigid;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, Precision};

/// A direction or a point.
pub(super) type Triple = [Number; 3];

/// Decimals that end within so many places are written whole: as many as a double has digits.
const PLACES: u32 = 17;

/// So many significant digits say that a number is known as well as a double: from twelve on, zeros at the end of all numbers of a file
/// are taken for padding that says nothing.
const DIGITS: usize = 11;

/// Decimals of a number that a computation missed by roundings.
const FEW: usize = 9;

/// Up to so many decimals are chosen by people, and taken for exact.
const CHOSEN: usize = Precision::EXACT_DECIMALS as usize;

/// What is computed from entries of about 1 and lies below this is a zero with its rounding errors.
const NOISE: f64 = 1e-15;

/// How far the entries of a pose may be from those of the identity, which it then is: some thousand roundings.
const SAME: f64 = 1e-12;

/// A computed double.
pub(super) fn rounded(x: f64) -> Number {
    if x.abs() < NOISE {
        return Number::zero();
    }
    Number::from_f64(x).unwrap_or_else(Number::zero)
}

/// The value of a joint at a pose (rad, m), zero within rounding errors.
pub(super) fn settled(x: f64) -> f64 {
    if x.abs() < SAME { 0.0 } else { x }
}

/// Computed doubles.
pub(super) fn triple(v: [f64; 3]) -> Triple {
    v.map(rounded)
}

/// The doubles of a triple.
pub(super) fn values(v: &Triple) -> [f64; 3] {
    v.each_ref().map(Number::value)
}

pub(super) fn zeros() -> Triple {
    [Number::zero(), Number::zero(), Number::zero()]
}

/// A number: a literal as it was read, what ends as a decimal whole, anything else as a double that reads back the same, but for a few
/// roundings of what else is a short decimal. A decimal says how well it is known, so that an exact one does not stop where its digits
/// do: `12.001` would be a number known to three decimals.
pub(super) fn text(number: &Number) -> String {
    if let Some(literal) = number.literal_text() {
        return literal.to_owned();
    }
    let value = number.value() + 0.0;
    let short = number.decimal_text(PLACES);
    let short = short.or_else(|| without_roundings(value));
    let short = short.unwrap_or_else(|| format!("{value:?}"));
    // What was computed from decimals is known as well as the worst of them.
    let known = number
        .coarsest_input()
        .map_or(DIGITS, |decimals| usize::try_from(decimals).unwrap_or(0));
    let digits = |text: &str| {
        let digits = text.chars().filter(char::is_ascii_digit);
        digits.skip_while(|digit| *digit == '0').count()
    };
    if let Some((mantissa, _)) = short.split_once('e') {
        return match digits(mantissa) < DIGITS && known == DIGITS {
            true => format!("{value:.0$e}", DIGITS - 1),
            false => short,
        };
    }
    let decimals = short
        .split_once('.')
        .map_or(0, |(_, decimals)| decimals.len());
    if decimals <= CHOSEN {
        return short;
    }
    let places = DIGITS.saturating_sub(digits(&short));
    let places = match number.coarsest_input() {
        Some(_) => places.min(known.saturating_sub(decimals)),
        None => places,
    };
    short + &"0".repeat(places)
}

/// The decimal of few places that a double is but for the roundings of a computation, as `3.500000000000001` is 3.5: readers that know the
/// decimal would take its own digits for all that is known of it.
fn without_roundings(value: f64) -> Option<String> {
    let text = format!("{value:.FEW$}");
    let near = text.trim_end_matches('0').trim_end_matches('.');
    let roundings = 4.0 * f64::EPSILON * value.abs().max(1.0);
    let apart = (near.parse::<f64>().ok()? - value).abs();
    (apart <= roundings).then(|| match near {
        "-0" => "0".to_owned(),
        _ => near.to_owned(),
    })
}

/// Numbers with spaces between them.
pub(super) fn texts(numbers: &[Number]) -> String {
    let words: Vec<String> = numbers.iter().map(text).collect();
    words.join(" ")
}

/// Whether a pose is the identity, but for rounding errors.
pub(super) fn is_identity(pose: &Rigid<f64>) -> bool {
    is_straight(pose) && pose.translation.iter().all(|x| x.abs() < SAME)
}

/// Whether a pose does not turn, but for rounding errors.
pub(super) fn is_straight(pose: &Rigid<f64>) -> bool {
    pose.rotation.iter().enumerate().all(|(i, row)| {
        row.iter().enumerate().all(|(j, x)| {
            let expected = f64::from(u8::from(i == j));
            (*x - expected).abs() < SAME
        })
    })
}

/// The pose of a frame.
pub(super) fn rigid(frame: &Frame) -> Rigid<f64> {
    let mut pose = Rigid::translation(values(&frame.position));
    for (axis, angle) in frame.roll_pitch_yaw.iter().enumerate().rev() {
        let (sine, cosine) = angle.value().sin_cos();
        let direction = [0, 1, 2].map(|i| if i == axis { 1.0 } else { 0.0 });
        pose = pose.compose(&Rigid::rotation(&direction, &cosine, &sine));
    }
    pose
}

/// Where a frame is in another one.
#[derive(Clone, Debug)]
pub(super) enum Place {
    /// As the file says it.
    Stated(Frame),
    /// Computed.
    Computed(Rigid<f64>),
}

impl Place {
    /// `pos` and `euler` (of the sequence XYZ) or `quat`, each left out where it is zero.
    pub(super) fn attributes(&self) -> String {
        match self {
            Self::Stated(frame) => {
                let said = |name: &str, numbers: &Triple| match numbers.iter().all(Number::is_zero)
                {
                    true => String::new(),
                    false => format!(" {name}=\"{}\"", texts(numbers)),
                };
                said("pos", &frame.position) + &said("euler", &frame.roll_pitch_yaw)
            }
            Self::Computed(pose) => {
                let mut words = String::new();
                let position = triple(pose.translation);
                if !position.iter().all(Number::is_zero) {
                    words = format!(" pos=\"{}\"", texts(&position));
                }
                if !is_straight(pose) {
                    let [x, y, z, w] = pose.quaternion().map(rounded);
                    words += &format!(" quat=\"{}\"", texts(&[w, x, y, z]));
                }
                words
            }
        }
    }

    /// As a displacement.
    pub(super) fn rigid(&self) -> Rigid<f64> {
        match self {
            Self::Stated(frame) => rigid(frame),
            Self::Computed(pose) => pose.clone(),
        }
    }

    /// Where a place in this one is; what is nowhere else keeps its digits.
    pub(super) fn then(self, next: Self) -> Self {
        let stays = |place: &Self| matches!(place, Self::Stated(frame) if frame.is_identity());
        if stays(&next) {
            return self;
        }
        if stays(&self) {
            return next;
        }
        Self::Computed(self.rigid().compose(&next.rigid()))
    }

    /// The other way round; a frame that is not turned keeps its digits.
    pub(super) fn inverse(&self) -> Self {
        match self {
            Self::Stated(frame) if frame.roll_pitch_yaw.iter().all(Number::is_zero) => {
                Self::Stated(Frame::at(frame.position.each_ref().map(|x| -x)))
            }
            _ => Self::Computed(self.rigid().inverse()),
        }
    }

    /// As position, roll, pitch and yaw.
    pub(super) fn frame(&self) -> Frame {
        match self {
            Self::Stated(frame) => frame.clone(),
            Self::Computed(pose) => Frame {
                position: triple(pose.translation),
                roll_pitch_yaw: triple(roll_pitch_yaw(pose)),
            },
        }
    }
}

/// Roll, pitch and yaw; where the pitch is a right angle the roll is taken as zero.
fn roll_pitch_yaw(pose: &Rigid<f64>) -> [f64; 3] {
    let r = &pose.rotation;
    let flat = r[0][0].hypot(r[1][0]);
    let pitch = (-r[2][0]).atan2(flat);
    if flat > SAME {
        [r[2][1].atan2(r[2][2]), pitch, r[1][0].atan2(r[0][0])]
    } else {
        [0.0, pitch, (-r[0][1]).atan2(r[1][1])]
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_they_were_read() {
        let literal = Number::decimal("0.100").unwrap();
        assert_eq!(text(&literal), "0.100");
        let ratio = |over: i64, under: i64| Number::ratio(over, under).unwrap();
        assert_eq!(text(&ratio(1, 4)), "0.25");
        // Exact numbers, and doubles, are no rounded ones.
        assert_eq!(text(&ratio(1, 8)), "0.12500000000");
        assert_eq!(text(&ratio(-12_001, 1000)), "-12.001000000");
        assert_eq!(text(&rounded(0.001)), "0.0010000000000");
        assert_eq!(text(&rounded(1e-7)), "0.00000010000000000");
        assert_eq!(text(&rounded(1e-12)), "1.0000000000e-12");
        // What a computation missed by roundings.
        assert_eq!(text(&rounded(3.500000000000001)), "3.5");
        assert_eq!(text(&rounded(-1.9999999999999998)), "-2");
        assert_eq!(text(&rounded(0.9990000000000001)), "0.99900000000");
        assert_eq!(text(&rounded(0.6324555320336759)), "0.6324555320336759");
        // What was computed from decimals of one and three places is known to one.
        let sum = &Number::decimal("0.5").unwrap() + &Number::decimal("0.125").unwrap();
        assert_eq!(text(&sum), "0.625");
        let sum = &Number::decimal("0.0625").unwrap() + &Number::decimal("0.3000").unwrap();
        assert_eq!(text(&sum), "0.3625");
        assert_eq!(text(&Number::ratio(1, 3).unwrap()), "0.3333333333333333");
        assert_eq!(text(&rounded(-3e-17)), "0");
    }

    #[test]
    fn places_one_after_another_keep_their_digits() {
        let number = |text: &str| Number::decimal(text).unwrap();
        let stated = || Place::Stated(Frame::at([number("0.10"), number("2"), number("-3")]));
        let here = || Place::Stated(Frame::identity());
        for place in [stated().then(here()), here().then(stated())] {
            assert_eq!(texts(&place.frame().position), "0.10 2 -3");
        }
        let back = stated().inverse().frame();
        assert_eq!(values(&back.position), [-0.1, -2.0, 3.0]);
        let both = stated().then(stated().inverse());
        assert!(is_identity(&both.rigid()));
        let turned = Place::Stated(Frame {
            position: stated().frame().position,
            roll_pitch_yaw: [number("0.3"), number("-0.7"), number("1.9")],
        });
        let both = turned.inverse().then(turned);
        assert!(is_identity(&both.rigid()));
        assert_eq!(settled(-1e-13), 0.0);
        assert_eq!(settled(-1e-11), -1e-11);
    }

    #[test]
    fn angles_of_a_pose_give_it_back() {
        for angles in [[0.3, -0.7, 1.9], [0.0, std::f64::consts::FRAC_PI_2, 0.4]] {
            let mut pose = Rigid::identity(&1.0);
            for (axis, angle) in angles.iter().enumerate().rev() {
                let mut direction = [0.0; 3];
                direction[axis] = 1.0;
                let turn = Rigid::rotation(&direction, &angle.cos(), &angle.sin());
                pose = pose.compose(&turn);
            }
            for (found, expected) in roll_pitch_yaw(&pose).iter().zip(angles) {
                assert!((found - expected).abs() < 1e-12);
            }
        }
    }
}
