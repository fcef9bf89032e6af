use super::super::Direction;
use super::super::{Frame, JointBuilder, JointId, JointKind, MechanismBuilder};
use super::*;
use kutzbach_math::number::{Inputs, Quantity};
use proptest::prelude::*;

fn number(text: &str) -> Number {
    Number::decimal(text).unwrap()
}

/// The precision of a loop whose geometry holds these numbers.
fn of(texts: &[&str]) -> Precision {
    *loop_of("", texts).build().unwrap().precision()
}

/// A loop of fixed joints, `name`d and counted from `0`, whose geometry holds these numbers.
fn loop_of(name: &str, texts: &[&str]) -> MechanismBuilder {
    let mut builder = MechanismBuilder::new("numbers");
    builder.link("0");
    add_loop(&mut builder, name, texts);
    builder
}

fn add_loop(builder: &mut MechanismBuilder, name: &str, texts: &[&str]) {
    let link = |index: usize| match index {
        0 => "0".to_owned(),
        _ => format!("{name}{index}"),
    };
    for (index, text) in texts.iter().enumerate() {
        let (parent, child) = (link(index), link(index + 1));
        builder.link(&child);
        let frame = Frame::at([number(text), Number::zero(), Number::zero()]);
        let joint = format!("{name}j{index}");
        builder.joint(JointBuilder::tree(&joint, JointKind::Fixed, &parent, &child).origin(frame));
    }
    if !texts.is_empty() {
        let (last, closing) = (link(texts.len()), format!("{name}closing"));
        builder.joint(JointBuilder::closing(
            &closing,
            JointKind::Fixed,
            "0",
            &last,
        ));
    }
}

#[test]
fn what_is_in_no_loop_states_nothing() {
    let mut builder = loop_of("a", &["0.25", "3"]);
    add_loop(&mut builder, "b", &["0.866025", "1"]);
    for (at, joint) in [("0", "mount"), ("a1", "bracket")] {
        let frame = Frame::at_point([0.123456789, 0.0, 1000.5]).unwrap();
        let camera = format!("{joint}_camera");
        builder.link(&camera);
        builder.joint(JointBuilder::tree(joint, JointKind::Fixed, at, &camera).origin(frame));
    }
    let mechanism = builder.build().unwrap();
    let of = |name: &str| *mechanism.precision_of(mechanism.joint_named(name).unwrap());
    assert_eq!(of("aj0"), super::tests::of(&["0.25", "3"]));
    assert!(of("aj0").is_exact() && of("mount").is_exact() && of("bracket").is_exact());
    assert_eq!(of("mount").uncertainty(0, &number("0.123456789")), 0.0);
    assert_eq!(of("bj1").decimals, Some(6));
    assert_uncertainty(&of("bj1"), "0.5", 0.5e-6);
    // Together they are what the less exact one is, and it is told by which number.
    let together = mechanism.precision();
    assert!(!together.is_exact());
    let rounded_by = mechanism.joint_named("bj0").unwrap().0;
    assert_eq!(
        together.rounded_by(),
        Some(LiteralPlace::Joint(rounded_by, 0))
    );
    assert_eq!(of("aj0").rounded_by(), None);
    let by_hand = mechanism.with_precision(1e-3);
    assert!(!by_hand.precision_of(JointId(0)).is_exact());
    let mount = by_hand.joint_named("mount").unwrap();
    assert!(by_hand.precision_of(mount).is_exact());
}

#[track_caller]
fn assert_uncertainty(precision: &Precision, text: &str, expected: f64) {
    let found = precision.uncertainty(0, &number(text));
    assert!(
        (found - expected).abs() <= 1e-12 * expected,
        "{text}: {found:e} instead of {expected:e}"
    );
}

/// A number that changes by `slope` times what an angle changes by.
fn worked_out(value: Number, angle: &str, slope: f64) -> Number {
    let mut inputs = Inputs::default();
    inputs.add(Quantity::Angle, &number(angle), slope);
    value.derived_from(inputs)
}

#[test]
fn what_is_worked_out_is_as_uncertain_as_the_literals_behind_it() {
    let of = |numbers: &[Number]| {
        let placed = numbers.iter().map(|n| (LiteralPlace::Joint(0, 0), n));
        let [precision, _] = Precision::of(placed, []);
        precision
    };
    let quarter = || Number::from_f64(0.25).unwrap();
    let rounded = [
        worked_out(quarter(), "0.433013", 2.0),
        worked_out(quarter(), "0.776457", 1.0),
    ];
    let precision = of(&rounded);
    assert!(!precision.is_exact());
    assert_eq!(precision.decimals, Some(6));
    let off = |precision: &Precision| rounded.each_ref().map(|n| precision.uncertainty(0, n));
    let [two, one] = off(&precision);
    assert!((two - 1e-6).abs() < 1e-15 && (one - 0.5e-6).abs() < 1e-15);
    assert_eq!(off(&precision.known_to(1e-3)), [2e-3, 1e-3]);
    assert_eq!(off(&precision.known_to(0.0)), [0.0; 2]);
    // What was chosen leaves an exact number exact, and a computed one the rounding of its text.
    let exact = worked_out(quarter(), "0.3", 2.0);
    assert!(of(std::slice::from_ref(&exact)).is_exact());
    let computed = worked_out(number("0.295520206661340"), "0.3", 1.0);
    let precision = of(std::slice::from_ref(&computed));
    let own = of(&[number("0.295520206661340")]);
    assert!(!precision.is_exact() && precision == own);
    let left = precision.uncertainty(0, &computed);
    assert!(left > 0.0 && left < 1e-14, "{left:e}");
}

#[test]
fn beside_rounded_directions_lengths_in_a_small_unit_are_chosen() {
    let direction = (0..)
        .find(|place| Joint::kind_of_number(*place) == 2)
        .unwrap();
    let beside = |lengths: &[&str]| {
        let lengths: Vec<Number> = lengths.iter().map(|text| number(text)).collect();
        let third = number("0.333333333333");
        let all = lengths
            .iter()
            .map(|length| (LiteralPlace::Joint(0, 0), length));
        let all = all.chain([(LiteralPlace::Joint(0, direction), &third)]);
        let [precision, _] = Precision::of(all, []);
        lengths
            .iter()
            .map(|length| precision.uncertainty(0, length))
            .fold(0.0, f64::max)
    };
    assert_eq!(beside(&["0.002", "0.003", "0.001"]), 0.0);
    assert_eq!(beside(&["0.00002", "0.000035"]), 0.0);
    assert_eq!(beside(&["0.0012", "0.0007"]), 0.0);
    assert_eq!(beside(&["0.0123", "0.0007"]), 0.5e-4);
    assert_eq!(beside(&["0.025", "0.013", "0.01"]), 0.5e-3);
}

/// How far the lengths of a tree, and of the joints that close its loops, may be off; a coarse direction stands beside them.
fn two_sides(tree: &[&str], closing: &[&str]) -> [Vec<f64>; 2] {
    let direction = (0..)
        .find(|place| Joint::kind_of_number(*place) == 2)
        .unwrap();
    let sides = [tree, closing].map(|texts| texts.iter().map(|t| number(t)).collect());
    let placed = |side: &'static str| move |n| (LiteralPlace::Joint(side.len(), 0), n);
    let [tree, closing]: &[Vec<Number>; 2] = &sides;
    let third = number("0.3333");
    let axis = [(LiteralPlace::Joint(0, direction), &third)];
    let of_tree = tree.iter().map(placed("tree")).chain(axis);
    let found = Precision::of(of_tree, closing.iter().map(placed("closing")));
    [0, 1].map(|side| {
        let all = sides[side].iter();
        all.map(|n| found[side].uncertainty(0, n)).collect()
    })
}

#[test]
fn loops_of_another_program_have_digits_of_their_own() {
    let six = ["0.659148", "-1.641397", "1.860928", "-0.049371", "-0.40791"];
    let four = ["-0.0394", "2.4030", "-0.6885", "-1.649"];
    assert_eq!(two_sides(&six, &four), [vec![0.5e-6; 5], vec![0.5e-4; 4]]);
    // The other way round as well; and numbers that somebody chose are no rounded ones.
    assert_eq!(two_sides(&four, &six), [vec![0.5e-4; 4], vec![0.5e-6; 5]]);
    let [_, chosen] = two_sides(&six, &["0.125", "0.25", "0.375", "2"]);
    assert_eq!(chosen, [0.5e-6; 4]);
    let [whole, _] = two_sides(&["0.000002", "0.000001"], &["0.0000012566370614359172953"]);
    assert!(whole.iter().all(|u| *u < 1e-20));
    let doubles = [
        "0.6591480000000017",
        "-1.6413970000000123",
        "1.860928317762219",
    ];
    let [full, fine] = two_sides(&doubles, &["0.659148", "-1.641397", "0.3059"]);
    assert!(full.iter().all(|u| *u < 1e-15));
    assert_eq!(fine, [0.5e-6; 3]);
}

#[test]
fn an_axis_of_single_digits_was_typed() {
    let direction = (0..)
        .find(|place| Joint::kind_of_number(*place) == 2)
        .unwrap();
    let axis = |texts: [&str; 3]| {
        let numbers = texts.map(number);
        let placed = numbers
            .iter()
            .map(|n| (LiteralPlace::Joint(0, direction), n));
        let [precision, _] = Precision::of(placed, []);
        precision.uncertainty(direction, &numbers[1])
    };
    assert_eq!(axis(["1", "0.001", "0"]), 0.0);
    assert_eq!(axis(["0.707", "0.707", "0"]), 0.5e-3);
}

#[test]
fn lengths_of_four_digits_beside_rounded_directions_are_rounded() {
    let printed = [
        "-45.73", "79.99", "102.5", "-17.34", "72.82", "105", "-8.94",
    ];
    let [off, _] = two_sides(&printed, &[]);
    for (found, expected) in off.iter().zip([5e-3, 5e-3, 0.05, 5e-3, 5e-3, 0.05, 5e-3]) {
        assert!((found - expected).abs() <= 1e-9, "{off:?}");
    }
    let [chosen, _] = two_sides(&["45", "80.5", "12.25", "7", "30", "105"], &[]);
    assert_eq!(chosen, [0.0; 6]);
}

#[test]
fn a_longer_number_among_short_ones_was_typed() {
    let rounded = of(&["0.35", "0.71", "0.4", "1.27", "0.28", "0.93"]);
    assert!(rounded.is_exact() && rounded.may_be_rounded_to(2) && !rounded.may_be_rounded_to(3));
    assert!(of(&["0.10", "0.20", "0.30", "0.01", "0.50", "0.60"]).may_be_rounded_to(2));
    let typed = of(&["0.1", "0.2", "0.3", "0.01", "0.5", "0.6"]);
    assert!(typed.is_exact() && !typed.may_be_rounded_to(2));
}

#[test]
fn fixed_decimals_with_stripped_zeros() {
    // Written with four decimals: 0.5 stands for 0.5000. Five significant digits from 12.3457 do not bind.
    let precision = of(&["0.8660", "12.3457", "0.5", "0"]);
    assert_eq!(precision.decimals, Some(4));
    assert_eq!(precision.significant, 6);
    for text in ["0.866", "12.3457", "0.5", "0", "0.0000", "-0.25"] {
        assert_uncertainty(&precision, text, 0.5e-4);
    }
}

#[test]
fn significant_digits_with_stripped_zeros() {
    // Six significant digits: 123.457, 0.0123457, and 8 for 8.00000.
    let precision = of(&["123.457", "0.0123457", "8"]);
    assert_eq!((precision.decimals, precision.significant), (Some(7), 6));
    assert_uncertainty(&precision, "123.457", 0.5e-3);
    assert_uncertainty(&precision, "0.0123457", 0.5e-7);
    assert_uncertainty(&precision, "8", 0.5e-5);
    assert_uncertainty(&precision, "-25.5", 0.5e-4);
    // 2000.00, of which nothing but the 2 is left.
    assert_uncertainty(&precision, "2000", 0.5e-2);
    assert_uncertainty(&precision, "2e3", 0.5e-2);
    // A zero has no digits: the finest decimal place of the file.
    assert_uncertainty(&precision, "0", 0.5e-7);
}

#[test]
fn zeros_state_no_decimals_of_other_numbers() {
    for texts in [
        &["1", "2", "0.000000"][..],
        &["0.25", "0.000000000000000"],
        &["0.000"],
    ] {
        let precision = of(texts);
        assert!(precision.is_exact(), "{texts:?}");
        assert_uncertainty(&precision, texts[0], 0.0);
    }
    let rounded = of(&["0.866", "1", "0.000000"]);
    assert_eq!((rounded.decimals, rounded.significant), (Some(3), 3));
    assert_uncertainty(&rounded, "0", 0.5e-3);
    assert_uncertainty(&rounded, "0.000000", 0.5e-6);
    // By hand, zeros are as uncertain as anything.
    assert!(!of(&["0.000"]).known_to(1e-3).is_exact());
}

#[test]
fn more_than_17_digits_of_a_double_state_nothing() {
    let double = "2.121320343559642385145025400561280548572540283203125";
    assert_uncertainty(&of(&[double, "3"]), double, 0.5e-16);
    assert_uncertainty(&of(&["2.12132034355964238515", "3"]), "3", 0.5e-16);
    // √(9/2) in as many digits is no double.
    let longer = "2.121320343559642573202533086314547117854507813065422";
    assert_uncertainty(&of(&[longer, double]), longer, 0.5e-51);
}

#[test]
fn powers_of_ten_belong_to_the_decade_they_begin() {
    let precision = of(&["1.23456", "0.000123456"]);
    assert_eq!((precision.decimals, precision.significant), (Some(9), 6));
    for exponent in -4..8 {
        let expected = 0.5 * 10f64.powi((exponent - 5).max(-9));
        assert_uncertainty(&precision, &format!("1e{exponent}"), expected);
        assert_uncertainty(&precision, &format!("9e{exponent}"), expected);
    }
}

#[test]
fn a_number_is_no_more_certain_than_its_own_digits_where_none_were_stripped() {
    let precision = of(&["1.234567890123456", "100.5"]);
    assert_uncertainty(&precision, "1.234567890123456", 0.5e-15);
    assert_uncertainty(&precision, "100.5", 0.5e-13);
}

#[test]
fn chosen_numbers_are_exact() {
    for texts in [
        &["0.25", "3", "-17.5", "1e3"][..],
        &["0"][..],
        &["300"][..],
        &["0.25", "0.125"][..],
        &["0.00425", "0.00125"][..],
        &[][..],
    ] {
        let precision = of(texts);
        assert!(precision.is_exact(), "{texts:?}");
        for text in texts {
            assert_eq!(precision.uncertainty(0, &number(text)), 0.0);
        }
    }
    // One number of three decimals, and none of them is chosen.
    let precision = of(&["0.25", "1.125"]);
    assert!(!precision.is_exact());
    assert_uncertainty(&precision, "0.25", 0.5e-3);
}

#[test]
fn zeros_at_the_end_of_every_literal_are_padding() {
    let precision = of(&[
        "0.112527000000",
        "0.025656900000",
        "1.000000000000",
        "0.000000000000",
        "-0.013100000000",
    ]);
    assert_eq!((precision.decimals, precision.significant), (Some(7), 6));
    assert_uncertainty(&precision, "0.112527000000", 0.5e-6);
    assert_uncertainty(&precision, "0.025656900000", 0.5e-7);
    assert_uncertainty(&precision, "0.000000000000", 0.5e-7);
    // One literal that has digits there, and they are stated.
    let precision = of(&[
        "0.112527000000",
        "0.025656900001",
        "1.000000000000",
        "-0.013100000000",
    ]);
    assert_uncertainty(&precision, "0.112527000000", 0.5e-12);
    // A single one may end so by choice.
    assert!(!of(&["0.500000000000"]).is_exact());
    assert!(!of(&["0.500000", "0.250000", "1.000000", "-0.750000"]).is_exact());
    assert!(
        of(&[
            "0.500000000000",
            "0.250000000000",
            "1.000000000000",
            "-0.750000000000"
        ])
        .is_exact()
    );
}

#[test]
fn expressions_are_exact() {
    let expression = |text: &str| Number::expression(text, &mut |_| Ok(None)).unwrap();
    let mut builder = MechanismBuilder::new("exact");
    builder.link("a").link("b");
    builder.joint(
        JointBuilder::tree("j", JointKind::Screw, "a", "b")
            .origin(Frame::at([
                expression("sqrt(3)/2"),
                expression("0.123456789"),
                Number::from_f64(0.1).unwrap(),
            ]))
            .lead(expression("1/3")),
    );
    builder.joint(JointBuilder::closing("k", JointKind::Fixed, "a", "b"));
    let precision = *builder.build().unwrap().precision();
    assert_eq!(precision, Precision::default());
    assert!(precision.is_exact());
    // Beside rounded numbers they stay exact.
    let rounded = of(&["0.866025"]);
    assert_eq!(rounded.uncertainty(0, &expression("sqrt(3)/2")), 0.0);
    assert_eq!(rounded.uncertainty(0, &expression("0.866025")), 0.0);
}

/// Numbers that were rounded are as uncertain as their digits say, also where a program has printed some of its own beside them in full.
#[test]
fn a_few_doubles_do_not_make_rounded_numbers_doubles() {
    let rounded = [
        "0.12345", "0.45612", "0.78934", "0.24631", "0.71739", "0.90113",
    ];
    let of_both = |doubles: &[&str]| of(&[&rounded[..], doubles].concat());
    let mixed = of_both(&["0.11401770824708224"]);
    assert!(!mixed.is_of_doubles() && !mixed.is_in_full());
    assert!((mixed.uncertainty(0, &number("0.45612")) / 5e-6 - 1.0).abs() < 1e-9);
    let doubles = ["0.11401770824708224", "0.25297529986988493"];
    let doubles = of(&doubles);
    assert!(doubles.is_of_doubles() && doubles.is_in_full());
}

#[test]
fn every_number_of_the_geometry_is_read() {
    let frame = |position: &str, angle: &str| Frame {
        position: [Number::zero(), Number::zero(), number(position)],
        roll_pitch_yaw: [Number::zero(), number(angle), Number::zero()],
    };
    let along = |text: &str| Direction([Number::one(), number(text), Number::zero()]);
    let hinge = || JointBuilder::tree("j", JointKind::Universal, "a", "b");
    let screw = JointBuilder::tree("j", JointKind::Screw, "a", "b");
    let rod = JointBuilder::tree("j", JointKind::Distance, "a", "b");
    for joint in [
        hinge().origin(frame("0.125", "0")),
        hinge().origin(frame("0", "0.125")),
        hinge().successor_origin(frame("0.125", "0")),
        hinge().axis(along("0.125")),
        hinge().axis2(along("0.125")),
        screw.lead(number("0.125")),
        rod.distance(number("0.125")),
    ] {
        let mut builder = MechanismBuilder::new("one");
        builder.link("a").link("b");
        builder.joint(joint);
        builder.joint(JointBuilder::closing("k", JointKind::Fixed, "a", "b"));
        let precision = *builder.build().unwrap().precision();
        assert_eq!((precision.decimals, precision.significant), (Some(3), 3));
    }
    let mut builder = MechanismBuilder::new("floating");
    builder.link("a").link("b");
    builder.floating("f", "a", "b", frame("0.125", "0"));
    for joint in ["j", "k"] {
        builder.joint(JointBuilder::closing(joint, JointKind::Spherical, "a", "b"));
    }
    assert_eq!(builder.build().unwrap().precision().decimals, Some(3));
}

#[test]
fn endless_digits_and_exponents_stay_in_range() {
    let long = format!("0.{}", "3".repeat(5000));
    let precision = of(&[&long, "1e-900"]);
    assert_eq!(precision.uncertainty(0, &number(&long)), 0.0);
    assert!(precision.uncertainty(0, &number("1e99")) < 1.0);
}

proptest! {
    /// A value written to a fixed number of decimals, or to a fixed number of significant digits, zeros stripped or
    /// not, is never further from the value meant than the file's precision says.
    #[test]
    fn the_value_meant_is_within_the_uncertainty(
        // Three digits at least: an integer is written out, whatever its digits are worth.
        values in prop::collection::vec(-999.0f64..999.0, 1..12),
        digits in 3usize..9,
        significant: bool,
        stripped: bool,
    ) {
        let write = |value: f64| {
            let decimals = if significant {
                // `{:e}` knows the decade of the rounded value.
                let scientific = format!("{value:.*e}", digits - 1);
                let exponent: i32 = scientific.split('e').nth(1).unwrap().parse().unwrap();
                usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0)
            } else {
                digits
            };
            let text = format!("{value:.decimals$}");
            if stripped && text.contains('.') {
                text.trim_end_matches('0').trim_end_matches('.').to_owned()
            } else {
                text
            }
        };
        let texts: Vec<String> = values.iter().map(|v| write(*v)).collect();
        let precision = of(&texts.iter().map(String::as_str).collect::<Vec<_>>());
        prop_assume!(!precision.is_exact());
        for (value, text) in values.iter().zip(&texts) {
            let written = number(text);
            let error = (written.value() - value).abs();
            let allowed = precision.uncertainty(0, &written);
            prop_assert!(
                error <= allowed * (1.0 + 1e-6) + 1e-12,
                "{} as {}: off by {:e}, allowed {:e}", value, text, error, allowed
            );
        }
    }
}

#[test]
fn lengths_that_are_parts_of_an_inch_were_rounded_there() {
    // 12.345 in, …
    let texts = [12_345, -671, 3_502, 8_003].map(|mils| (f64::from(mils) * 2.54e-5).to_string());
    let texts = texts.each_ref().map(String::as_str);
    let precision = of(&texts);
    let written = precision.written()[0];
    assert_eq!(written, Some(Written::Converted(OtherUnit::Inch, 3)));
    assert!(!precision.is_exact() && !precision.is_of_doubles() && !precision.is_in_full());
    for text in texts {
        let off = precision.uncertainty(0, &number(text)) - 1.27e-5;
        assert!(off.abs() < 1e-6, "{text}: {off:e}");
    }
    // Hundredths of an inch were chosen; micrometres are no parts of it.
    let chosen = ["0.31369", "-0.017018", "0.088900", "0.203454"];
    for texts in [chosen, ["0.313561", "-0.017043", "0.088951", "0.203276"]] {
        let written = of(&texts).written()[0];
        assert!(
            !matches!(written, Some(Written::Converted(..))),
            "{texts:?}"
        );
    }
}
