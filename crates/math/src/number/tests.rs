//! What the module promises, seen from outside.
#![allow(clippy::unwrap_used)]

use super::*;
use proptest::prelude::*;
use std::f64::consts::PI;

fn read(text: &str) -> Number {
    Number::expression(text, &mut |_| Ok(None)).unwrap()
}

fn refused(text: &str) -> NumberError {
    Number::expression(text, &mut |_| Ok(None)).unwrap_err()
}

/// Reads the text of a number as a file would.
fn reread(x: &Number) -> Number {
    let source = x.source();
    match source.strip_prefix("${").and_then(|s| s.strip_suffix('}')) {
        Some(text) => read(text),
        None => Number::decimal(&source).unwrap(),
    }
}

#[test]
fn proven_identities() {
    for (left, right) in [
        ("sqrt(3)/2", "cos(pi/6)"),
        ("sqrt(3)/2", "sin(acos(1/2))"),
        ("sin(acos(3/5))", "4/5"),
        ("cos(2*acos(3/5))", "-7/25"),
        ("sin(3*asin(1/3))", "3*(1/3) - 4*(1/3)**3"),
        ("cos(radians(15))", "(sqrt(6)+sqrt(2))/4"),
        ("sin(radians(15))", "(sqrt(6)-sqrt(2))/4"),
        ("radians(30)", "pi/6"),
        ("radians(180)", "pi"),
        ("sin(pi/5)", "sqrt((5-sqrt(5))/8)"),
        ("sin(pi/5)*sin(2*pi/5)", "sqrt(5)/4"),
        ("sin(pi/8)", "sqrt(2-sqrt(2))/2"),
        ("cos(pi/24)**2 + sin(pi/24)**2", "1"),
        ("cos(pi/7)**2 + sin(pi/7)**2", "1"),
        ("cos(pi/7) - cos(2*pi/7) + cos(3*pi/7)", "1/2"),
        ("sin(radians(40))", "2*sin(radians(20))*cos(radians(20))"),
        ("8*cos(pi/9)**3 - 6*cos(pi/9)", "1"),
        ("tan(pi/4)", "1"),
        ("tan(radians(75))", "2+sqrt(3)"),
        ("acos(3/5) + asin(3/5)", "pi/2"),
        ("atan(1/2) + atan(1/3)", "pi/4"),
        ("4*atan(1/5) - atan(1/239)", "pi/4"),
        ("2*atan(1/3) + atan(1/7)", "pi/4"),
        ("acos(-1/2)", "2*pi/3"),
        ("asin(-sqrt(2)/2)", "-pi/4"),
        ("acos((1+sqrt(5))/4)", "pi/5"),
        ("atan2(1, -1)", "3*pi/4"),
        ("atan2(-3, -4)", "atan(3/4) - pi"),
        ("acos(cos(pi/3))", "pi/3"),
        ("cos(acos(3/5)/2)", "2/sqrt(5)"),
        ("sin(acos(7/25)/2)", "3/5"),
        ("cos(acos(sqrt(2)/3)+pi/4)", "1/3 - sqrt(14)/6"),
        ("acos(3/5)/acos(3/5)", "1"),
        ("pi/(2*pi)", "1/2"),
        ("sqrt(5+2*sqrt(6))", "sqrt(2)+sqrt(3)"),
        ("sqrt(3-2*sqrt(2))", "sqrt(2)-1"),
        (
            "1/(sqrt(2)+sqrt(3)+sqrt(5))",
            "(2*sqrt(3)+3*sqrt(2)-sqrt(30))/12",
        ),
        ("sqrt(2)*sqrt(3)", "sqrt(6)"),
        ("sqrt(1/2)", "sqrt(2)/2"),
        ("2**(1/2)", "sqrt(2)"),
        ("8**(3/2)", "16*sqrt(2)"),
        ("4**(-1/2)", "0.5"),
        ("(1+sqrt(2))**-3", "5*sqrt(2)-7"),
        ("sqrt(2+sqrt(2))*sqrt(2-sqrt(2))", "sqrt(2)"),
        ("sqrt(2+sqrt(2))**3", "(2+sqrt(2))*sqrt(2+sqrt(2))"),
        ("sqrt(2+sqrt(2)) - sqrt(2+sqrt(2))", "0"),
        ("3*sqrt(2+sqrt(2)) - sqrt(8+4*sqrt(2))", "sqrt(2+sqrt(2))"),
        ("sqrt(2+sqrt(2)) + sqrt(2-sqrt(2))", "sqrt(4+2*sqrt(2))"),
        ("abs(sqrt(2)-3/2)", "3/2-sqrt(2)"),
        ("-2**2", "-4"),
        ("2**3**2", "512"),
        ("2**-1", "1/2"),
        ("1-2-3", "-4"),
        ("8/4/2", "1"),
        ("2*3+4*-5", "-14"),
        ("+-+3", "-3"),
        ("0**0", "1"),
        ("0.1+0.2", "0.3"),
    ] {
        let difference = read(left) - read(right);
        assert_eq!(difference.zero_test(), ZeroTest::Zero, "{left} = {right}");
        assert_eq!(read(left).value(), read(right).value(), "{left} = {right}");
    }
}

#[test]
fn near_misses_are_told_apart() {
    for (left, right) in [
        (
            "sqrt(3)/2",
            "0.866025403784438646763723170752936183471402626905190314",
        ),
        (
            "cos(pi/7)",
            "0.9009688679024191262361023195074450511659191621318571500535624231994",
        ),
        ("pi", "355/113"),
        ("sqrt(2)+sqrt(3)+sqrt(5)", "sqrt(7)+sqrt(11)-0.580599"),
        ("acos(3/5)", "acos(3/5+1e-60)"),
        ("sin(1)", "sin(1+1e-100)"),
        ("1e-300*sin(1)", "0"),
    ] {
        assert_ne!(read(left), read(right), "{left} ≠ {right}");
        assert_eq!((read(left) - read(right)).zero_test(), ZeroTest::NonZero);
    }
}

#[test]
fn symbolic_zeros_say_that_they_are_not_proven() {
    let x = read("sin(1)**2 + cos(1)**2 - 1");
    assert_eq!(x.zero_test(), ZeroTest::Indistinguishable);
    assert!(x.is_zero() && x.value() == 0.0);
    assert_eq!(x.evaluate(100), Float::ZERO);
    assert!(x.exact().is_none());
    assert_eq!(read("sqrt(sin(1)**2) - sin(1)"), Number::zero());
}

#[test]
fn normal_forms() {
    let kind = |text: &str| match read(text).exact() {
        Some(Exact::Rational(_)) => "rational",
        Some(Exact::Surd(_)) => "surd",
        Some(Exact::Algebraic(_)) => "algebraic",
        Some(Exact::Angle(_)) => "angle",
        None => "none",
    };
    for (text, expected) in [
        ("1/3", "rational"),
        ("sqrt(2)**2", "rational"),
        ("cos(pi/12)", "surd"),
        ("sin(pi/10)", "surd"),
        ("cos(pi/10)", "algebraic"),
        ("sin(pi/5)", "algebraic"),
        ("cos(pi/7)", "algebraic"),
        ("sqrt(1+sqrt(2))", "algebraic"),
        ("acos(1/3)", "angle"),
        ("pi/6+atan2(1, sqrt(7))", "angle"),
        ("cos(acos(1/3)+2*asin(1/4)-pi/3)", "surd"),
        ("cos(acos(1/3)/3)", "none"),
        ("cos(1)", "none"),
        ("pi**2", "none"),
        ("pi+1", "none"),
    ] {
        assert_eq!(kind(text), expected, "{text}");
    }
}

#[test]
fn errors_point_at_their_place() {
    for (text, offset, word) in [
        ("", 0, "end"),
        ("1+", 2, "end"),
        ("1 2", 2, "operator"),
        ("(1+2", 0, "closed"),
        ("1+2)", 3, "`)`"),
        ("()", 1, "`)`"),
        ("sin 1", 4, "`(`"),
        ("sin", 0, "`(`"),
        ("2^3", 1, "`^`"),
        ("1.2.3", 3, "decimal"),
        ("2*foo", 2, "foo"),
        ("foo(2)", 0, "foo"),
        ("2+sqrt(0-3)", 2, "negative"),
        ("acos(1.5)", 0, "[-1, 1]"),
        ("asin(-1-1e-30)", 0, "[-1, 1]"),
        ("1/0", 2, "not zero"),
        ("1/(cos(pi/3)-1/2)", 2, "not zero"),
        ("3+1/(sin(1)**2+cos(1)**2-1)", 4, "not zero"),
        ("atan2(0, sqrt(2)-2**(1/2))", 0, "origin"),
        ("0**-1", 0, "not zero"),
        ("tan(pi/2)", 0, "cosine"),
        ("2**(1/3)", 3, "half"),
        ("2**sqrt(2)", 3, "half"),
        ("2**1001", 3, "1000"),
        ("(-2)**(1/2)", 0, "negative"),
        ("atan2(1)", 0, "2 argument"),
        ("sin(1,2)", 0, "1 argument"),
        ("1,2", 1, "`,`"),
        ("(1,2)", 2, "`,`"),
        ("1+1e2000", 4, "exponent"),
        ("(pi**1000)**1000", 10, "2^20000"),
        ("2 & 3", 2, "`&`"),
        ("1 é", 2, "`é`"),
    ] {
        let error = refused(text);
        assert_eq!(error.offset, offset, "{text}: {error}");
        assert!(error.to_string().contains(word), "{text}: {error}");
    }
    assert!(refused("2^3").hint().unwrap().contains("**"));
}

#[test]
fn deep_and_long_texts_do_no_harm() {
    let deep = "(".repeat(100_000) + "1" + &")".repeat(100_000);
    assert!(matches!(refused(&deep).reason, Reason::TooLarge { .. }));
    let moderate = "(".repeat(10_000) + "1" + &")".repeat(10_000);
    assert_eq!(read(&moderate), Number::one());
    assert!(Number::expression(&"-".repeat(100_000), &mut |_| Ok(None)).is_err());
    let calls = "sin(".repeat(3_000) + "1" + &")".repeat(3_000);
    assert!(read(&calls).value() > 0.0);
    let long = vec!["sin(1)"; 3_000].join("+");
    let sum = read(&long);
    assert_eq!(sum.value(), 3000.0 * 1f64.sin());
    assert_eq!(reread(&sum), sum);
    let longer = vec!["sin(1)"; 10_000].join("+");
    assert!(matches!(refused(&longer).reason, Reason::TooLarge { .. }));
    let integers = vec!["1"; 100_000].join("+");
    assert_eq!(read(&integers), Number::integer(100_000));
}

#[test]
fn operators_store_what_grows_too_long() {
    let mut x = read("sin(1)");
    for _ in 0..20 {
        x = &x * &x + read("cos(2)");
    }
    assert!(x.nodes() <= MAX_NODES);
    let mut reference = 1f64.sin();
    for _ in 0..20 {
        reference = reference * reference + 2f64.cos();
    }
    assert!((x.value() - reference).abs() < 1e-12);
    let mut stored = x.clone();
    while stored.nodes() > 1 {
        stored = &stored * &x;
    }
    assert_eq!(reread(&stored), stored);
}

#[test]
fn surds_beyond_the_limits_stay_algebraic() {
    let primes = [2, 3, 5, 7, 11, 13, 17, 19];
    let product = primes.iter().fold(Number::one(), |product, p| {
        product * (Number::one() + Number::integer(*p).sqrt().unwrap())
    });
    assert!(matches!(product.exact(), Some(Exact::Algebraic(_))));
    let value: f64 = primes
        .iter()
        .map(|p| 1.0 + f64::from(*p as i32).sqrt())
        .product();
    assert!((product.value() / value - 1.0).abs() < 1e-14);
}

#[test]
fn names() {
    let mut lookup = |name: &str| match name {
        "leg.a" => Ok(Some(Number::decimal("0.866").unwrap())),
        "_b" => Ok(Some(Number::integer(3))),
        "bad" => Err("it depends on itself".to_owned()),
        _ => Ok(None),
    };
    let mut read = |text: &str| Number::expression(text, &mut lookup);
    assert_eq!(
        read("leg.a*_b").unwrap(),
        Number::ratio(2598, 1000).unwrap()
    );
    assert_eq!(read("leg.a").unwrap().source(), "0.866");
    let negated = read("-leg.a").unwrap();
    assert_eq!(negated.source(), "-0.866");
    assert_eq!(negated.stated().unwrap().decimals, 3);
    assert_eq!(negated.value(), -0.866);
    assert_eq!((-negated).source(), "0.866");
    let derived = read("2*leg.a").unwrap();
    assert_eq!(
        (derived.stated(), derived.coarsest_input()),
        (None, Some(3))
    );
    assert_eq!(read("cos(leg.a)").unwrap().coarsest_input(), Some(3));
    assert_eq!(read("0.5").unwrap().stated(), None);
    assert_eq!(read("0.5*_b").unwrap().coarsest_input(), None);
    let error = read("1+bad").unwrap_err();
    assert_eq!(
        (error.offset, error.to_string().contains("itself")),
        (2, true)
    );
    assert_eq!(read("1+worse").unwrap_err().offset, 2);
}

#[test]
fn constructors_and_texts() {
    assert_eq!(Number::from_f64(0.5), Number::ratio(1, 2));
    assert!(Number::from_f64(f64::NAN).is_none() && Number::from_f64(f64::INFINITY).is_none());
    assert_ne!(Number::from_f64(0.1), Number::ratio(1, 10));
    assert!(Number::from_f64(-0.0).unwrap().value().is_sign_positive());
    assert!(Number::ratio(1, 0).is_none());
    for (text, expected) in [
        ("3/6", "${1/2}"),
        ("-3", "${-3}"),
        ("sqrt(3)/2-1", "${-1 + 1/2*sqrt(3)}"),
        ("-sqrt(2)", "${-sqrt(2)}"),
        ("pi/6 - 2*acos(4/5)", "${1/6*pi - 2*acos(4/5)}"),
        ("sin(1)-cos(1)*(1+pi)", "${sin(1) - cos(1)*(1 + pi)}"),
        ("(sin(1)*2)**3/(1/2)", "${(sin(1)*2)**3/(1/2)}"),
    ] {
        assert_eq!(read(text).source(), expected);
    }
    assert_eq!(Number::decimal("0.50").unwrap().source(), "0.50");
    for x in [0.1, -1e300, 5e-324, f64::MAX] {
        let x = Number::from_f64(x).unwrap();
        assert_eq!(reread(&x), x);
    }
    assert_eq!(format!("{:?}", Number::integer(3)), "Number(${3})");
}

#[test]
fn values_are_correctly_rounded() {
    // Known digits beyond the double: pi = 3.14159265358979323846264338327950288...
    assert_eq!(read("pi").value(), PI);
    assert_eq!(read("sqrt(2)").value(), 2f64.sqrt());
    assert_eq!(read("1/3").value(), 1.0 / 3.0);
    // One over a power of two beside a tie: 1 + 2^-53 rounds to 1, anything above to the next double.
    assert_eq!(read("1 + 2**-53").value(), 1.0);
    assert_eq!(
        read("1 + 2**-53 + sin(1)*2**-300").value(),
        1.0 + f64::EPSILON
    );
    assert_eq!(read("1 + 2**-53 - sin(1)*2**-300").value(), 1.0);
    // Smallest subnormal.
    assert_eq!(read("sin(2**-1000)*2**-74").value(), 5e-324);
    assert_eq!(Number::decimal("1e999").unwrap().value(), f64::INFINITY);
}

#[test]
fn cancellation_is_evaluated_with_more_bits() {
    let x = read("(1+sin(2**-500))**2 - 1 - 2*sin(2**-500) - 2**-1000");
    // (1 + s)² − 1 − 2s = s², and s² − 2^-1000 = −2^-2000/3 + ... cannot be told from zero at 400 places.
    assert!(x.is_zero());
    let y = read("sin(2**-100) - 2**-100");
    let expected = -(2f64.powi(-300)) / 6.0;
    assert!((y.value() / expected - 1.0).abs() < 1e-15);
    let digits = y.evaluate(300);
    assert!((digits.to_f64().value() / expected - 1.0).abs() < 1e-15);
}

#[test]
fn huge_arguments_are_reduced_with_all_their_bits() {
    // sin(1e22) is a classic of wrong argument reduction.
    assert_eq!(read("sin(1e22)").value(), -0.852_200_849_767_188_8);
    let x = read("sin(10**1000*10**1000)");
    let square = &x * &x + read("cos(10**1000*10**1000)").power(2).unwrap();
    assert_eq!(square, Number::one());
}

#[test]
fn numbers_cross_threads() {
    fn check<T: Send + Sync + Clone>(x: T) -> T {
        x
    }
    let x = check(read("sin(1)"));
    let other = x.clone();
    let value = std::thread::spawn(move || other.value()).join().unwrap();
    assert_eq!(x.value(), value);
}

/// A text of an expression with the double it comes to.
fn expressions() -> impl Strategy<Value = (String, f64)> {
    let leaf = prop_oneof![
        (-9i32..10).prop_map(|n| (format!("({n})"), f64::from(n))),
        (1i32..30, 1i32..30).prop_map(|(n, d)| (format!("({n}/{d})"), f64::from(n) / f64::from(d))),
        (1i32..40).prop_map(|n| (format!("sqrt({n})"), f64::from(n).sqrt())),
        (-9i32..10, 1i32..13)
            .prop_map(|(k, n)| { (format!("({k}*pi/{n})"), f64::from(k) * PI / f64::from(n)) }),
        Just(("0.866".to_owned(), 0.866)),
    ];
    leaf.prop_recursive(4, 24, 2, |inner| {
        let pair = (inner.clone(), inner.clone());
        prop_oneof![
            pair.clone()
                .prop_map(|((a, x), (b, y))| (format!("({a}+{b})"), x + y)),
            pair.clone()
                .prop_map(|((a, x), (b, y))| (format!("({a}-{b})"), x - y)),
            pair.clone()
                .prop_map(|((a, x), (b, y))| (format!("({a}*{b})"), x * y)),
            pair.prop_map(|((a, x), (b, y))| (format!("({a}/({b}))"), x / y)),
            inner
                .clone()
                .prop_map(|(a, x)| (format!("sin({a})"), x.sin())),
            inner
                .clone()
                .prop_map(|(a, x)| (format!("cos({a})"), x.cos())),
            inner
                .clone()
                .prop_map(|(a, x)| (format!("atan({a})"), x.atan())),
            inner
                .clone()
                .prop_map(|(a, x)| (format!("acos(({a})/100)"), (x / 100.0).acos())),
            inner.prop_map(|(a, x)| (format!("sqrt(abs({a}))"), x.abs().sqrt())),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    /// The error of the double evaluation is not bounded in general; where it is moderate, both must agree.
    #[test]
    fn values_agree_with_doubles((text, double) in expressions()) {
        if let Ok(x) = Number::expression(&text, &mut |_| Ok(None)) {
            let value = x.value();
            let size = double.abs();
            // Roots of a double's rounding are far from the zero they stand for.
            if size > 1e-6 && size < 1e6 && !x.is_zero() {
                prop_assert!((value - double).abs() < 1e-5 * size, "{} = {} or {}", text, value, double);
            }
            let exact = x.evaluate(200);
            prop_assert_eq!(exact.to_f64().value() + 0.0, value, "{}", text);
        }
    }

    #[test]
    fn more_bits_agree((text, _) in expressions()) {
        if let Ok(x) = Number::expression(&text, &mut |_| Ok(None)) {
            let (coarse, fine) = (x.evaluate(200), x.evaluate(400));
            if x.is_zero() {
                prop_assert_eq!(coarse, Float::ZERO);
            } else {
                let gap = (&coarse - &fine) / &fine;
                prop_assert!(gap.to_f64().value().abs() <= 2f64.powi(-199), "{}", text);
            }
        }
    }

    #[test]
    fn the_text_reads_back((text, _) in expressions()) {
        if let Ok(x) = Number::expression(&text, &mut |_| Ok(None)) {
            let again = reread(&x);
            prop_assert_eq!(again.value(), x.value(), "{} -> {}", text, x.source());
            prop_assert!(again == x, "{} -> {}", text, x.source());
        }
    }

    #[test]
    fn surds_form_a_field(a in surds(), b in surds(), c in surds()) {
        prop_assert_eq!(&(&a + &b) * &c, &(&a * &c) + &(&b * &c));
        prop_assert_eq!(&(&a * &b) * &c, &a * &(&b * &c));
        prop_assert_eq!(&a + &(&b + &c), &(&a + &b) + &c);
        prop_assert_eq!(&a - &a, Number::zero());
        if !b.is_zero() {
            prop_assert_eq!(&a.checked_div(&b).unwrap() * &b, a.clone());
        }
        prop_assert_eq!((&a * &a).sqrt().unwrap(), a.abs());
        prop_assert!((&a + &b).exact().is_some());
    }

    /// Addition theorem and inverse functions on angles that are exact.
    #[test]
    fn angles_are_consistent(n in -20i64..21, d in 1i64..21, k in -5i64..6, m in 1i64..13) {
        let x = Number::ratio(n, d.max(n.abs())).unwrap();
        let fraction = &Number::pi() * &Number::ratio(k, m).unwrap();
        let angle = x.asin().unwrap() + fraction;
        let (cos, sin) = angle.cos_sin();
        prop_assert_eq!(&(&cos * &cos) + &(&sin * &sin), Number::one());
        prop_assert!((cos.value() - angle.value().cos()).abs() < 1e-13);
        prop_assert!((sin.value() - angle.value().sin()).abs() < 1e-13);
        prop_assert_eq!(x.asin().unwrap().cos_sin().1, x.clone());
        prop_assert_eq!(x.acos().unwrap().cos_sin().0, x);
        let (double_cos, _) = (&angle + &angle).cos_sin();
        prop_assert_eq!(double_cos, &(&cos * &cos) - &(&sin * &sin));
    }

    #[test]
    fn no_text_panics(text in "[0-9a-z+*/().,e -]{0,24}") {
        let _ = Number::expression(&text, &mut |_| Ok(Number::ratio(1, 3)));
    }
}

fn surds() -> impl Strategy<Value = Number> {
    let term = (
        -9i64..10,
        1i64..7,
        prop::sample::select(vec![1i64, 2, 3, 5, 6, 12, 35]),
    );
    prop::collection::vec(term, 0..4).prop_map(|terms| {
        terms.iter().fold(Number::zero(), |sum, &(n, d, radicand)| {
            let root = Number::integer(radicand).sqrt().unwrap();
            sum + Number::ratio(n, d).unwrap() * root
        })
    })
}

#[test]
fn nested_roots_are_known_as_well_as_one() {
    let roots = format!("{}2{}", "sqrt(1 + ".repeat(500), ")".repeat(500));
    let limit = read(&roots);
    let ball = limit.ball(evaluate::COARSE).unwrap();
    assert!(ball.is_accurate(evaluate::COARSE - 4));
    assert!((limit.value() - (1.0 + 5f64.sqrt()) / 2.0).abs() < 1e-15);
}

#[test]
fn decimals_that_end_are_written_whole() {
    let of = |text: &str| Number::expression(text, &mut |_| Ok(None)).unwrap();
    for (text, decimal) in [
        ("0", Some("0")),
        ("-1", Some("-1")),
        ("1/5", Some("0.2")),
        ("-1/8", Some("-0.125")),
        ("-125/4", Some("-31.25")),
        ("1/16", None),
        ("1/3", None),
        ("sqrt(2)", None),
    ] {
        assert_eq!(of(text).decimal_text(3).as_deref(), decimal, "{text}");
    }
    assert_eq!(of("1/16").decimal_text(4).unwrap(), "0.0625");
}
