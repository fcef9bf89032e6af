//! What the two forms of numbers say, and the store.

use super::{EXACT, TOLERANT};
use crate::{
    Answer, Certainty, Direction, Entity, Found, Line, Measured, Point, Side, World, WorldError,
    classify, coincide, contained, intersection,
};
use kutzbach_math::number::Number;

#[test]
fn roots_are_decided() {
    let root = |n| Number::integer(n).sqrt().expect("valid by construction");
    let zero = Number::zero;
    let along = Direction::new([root(2), Number::one(), zero()]).expect("valid by construction");
    let line: Entity<Number> = Line::new(Point([zero(), zero(), zero()]), along).into();
    let on = Point([Number::integer(2), root(2), zero()]).into();
    let beside = Point([
        Number::integer(2),
        Number::ratio(141_421, 100_000).expect("valid by construction"),
        zero(),
    ])
    .into();
    assert_eq!(contained(&on, &line), Ok(Answer::Yes));
    assert_eq!(contained(&beside, &line), Ok(Answer::No));
    // Of degree three: 2 cos 20° is a zero of x³ − 3 x − 1.
    let x = &Number::integer(20).radians().cos_sin().0 * &Number::integer(2);
    let cube = &(&x * &x) * &x;
    let polynomial = &(&cube - &(&x * &Number::integer(3))) - &Number::one();
    let found = Point([polynomial, zero(), zero()]).into();
    let origin = Point([zero(), zero(), zero()]).into();
    assert_eq!(coincide(&found, &origin), Ok(Answer::Yes));
}

#[test]
fn what_is_not_proven_is_said() {
    // sin² 1 + cos² 1 − 1: no bound is known for sines of rational numbers.
    let (cos, sin) = Number::one().cos_sin();
    let x = &(&(&cos * &cos) + &(&sin * &sin)) - &Number::one();
    let point: Entity<Number> = Point([x.clone(), Number::zero(), Number::zero()]).into();
    let origin = Point([Number::zero(), Number::zero(), Number::zero()]).into();
    assert_eq!(coincide(&point, &origin), Ok(Answer::Indistinguishable));
    let wall = EXACT.plane([0, 0, 0], [1, 0, 0]);
    let side = classify(&point, &wall).expect("valid by construction");
    assert_eq!(
        (side.value, side.certainty),
        (Side::In, Certainty::Indistinguishable)
    );
    assert!(Direction::new([x, Number::zero(), Number::zero()]).is_err());
}

#[test]
fn digits_are_respected() {
    let m = |x: f64, u: f64| Measured::new(x, u).expect("valid by construction");
    let at = |z: Measured| Entity::from(Point([m(1.0, 1e-3), m(2.0, 1e-3), z]));
    let floor = TOLERANT.plane([0, 0, 0], [0, 0, 1]);
    assert_eq!(
        contained(&at(m(5e-4, 1e-3)), &floor),
        Ok(Answer::WithinDigits)
    );
    assert_eq!(contained(&at(m(5e-3, 1e-3)), &floor), Ok(Answer::No));
    assert_eq!(contained(&at(m(0.0, 0.0)), &floor), Ok(Answer::Yes));
    assert!(Direction::new([m(1e-4, 1e-3), m(0.0, 0.0), m(0.0, 0.0)]).is_err());
    assert!(Measured::new(f64::NAN, 0.0).is_err() && Measured::new(1.0, -1.0).is_err());
    // Two measured lines meet within their digits.
    let up =
        Direction::new([m(0.0, 1e-6), m(0.0, 1e-6), m(1.0, 1e-6)]).expect("valid by construction");
    let upright = Line::new(Point([m(2.0, 1e-3), m(1e-5, 1e-3), m(3.0, 1e-3)]), up).into();
    let met = intersection(&TOLERANT.line([0, 0, 0], [1, 0, 0]), &upright)
        .expect("valid by construction");
    assert_eq!(met.certainty, Certainty::WithinDigits);
    let Found::Point(Point([x, ..])) = met.value else {
        panic!("{met:?}");
    };
    assert!(
        x.low() < 2.0 && x.high() > 2.0 && x.uncertainty() < 2e-3,
        "{x:?}"
    );
    // A literal states half a unit of its last decimal, an integer is exact.
    let length = Measured::stated(&Number::decimal("0.25").expect("valid by construction"))
        .expect("valid by construction");
    assert!(length.low() <= 0.245 && length.high() >= 0.255 && length.uncertainty() < 0.0051);
    let twelve = Measured::stated(&Number::decimal("12").expect("valid by construction"))
        .expect("valid by construction");
    assert_eq!((twelve.low(), twelve.high()), (12.0, 12.0));
    let third = Measured::stated(&Number::ratio(1, 3).expect("valid by construction"))
        .expect("valid by construction");
    assert!(third.low() < third.high());
}

#[test]
fn the_world_lets_no_reference_dangle() {
    let mut world = World::<Number>::new();
    assert!(world.is_empty());
    let a = world
        .store("a", EXACT.at([0, 0, 0]))
        .expect("valid by construction");
    let b = world
        .store("b", EXACT.at([1, 0, 0]))
        .expect("valid by construction");
    let taken = world.store("a", EXACT.at([2, 0, 0])).expect_err("refused");
    assert_eq!(taken, WorldError::NameTaken("a".to_owned()));
    assert_eq!(
        world.store(" ", EXACT.at([2, 0, 0])),
        Err(WorldError::NoName)
    );
    let line =
        Line::through(EXACT.at([0, 0, 0]), &EXACT.at([1, 0, 0])).expect("valid by construction");
    let l = world
        .store_made_from("l", line, &[a, b])
        .expect("valid by construction");
    assert_eq!(world.made_from(a), [l]);
    let in_use = world.delete(a).expect_err("refused");
    assert!(in_use.to_string().contains("`l` is"), "{in_use}");
    world.rename(l, "axis").expect("valid by construction");
    assert_eq!(
        (world.find("l"), world.find("axis"), world.name(l)),
        (None, Some(l), Some("axis"))
    );
    assert!(world.rename(l, "b").is_err());
    assert_eq!(
        world.iter().map(|(name, ..)| name).collect::<Vec<_>>(),
        ["a", "axis", "b"]
    );
    assert!(matches!(world.delete(l), Ok(Entity::Line(_))));
    // Its place is used again, its id is not.
    let c = world
        .store("c", EXACT.at([3, 0, 0]))
        .expect("valid by construction");
    assert!(world.get(l).is_none() && world.get(c).is_some() && l != c);
    assert_eq!(
        world.delete(l).expect_err("refused"),
        WorldError::Deleted(l)
    );
    assert!(
        world
            .store_made_from("d", EXACT.at([4, 0, 0]), &[l])
            .is_err()
    );
    assert_eq!(world.find("d"), None);
    let d = world
        .store_made_from("d", EXACT.at([4, 0, 0]), &[a])
        .expect("valid by construction");
    world
        .store_made_from("e", EXACT.at([5, 0, 0]), &[d])
        .expect("valid by construction");
    assert_eq!(world.delete_with_all_made_from_it(a), Ok(3));
    assert_eq!(
        world.iter().map(|(name, ..)| name).collect::<Vec<_>>(),
        ["b", "c"]
    );
    assert_eq!(world.len(), 2);
}
