//! Plane curves whose branches are known.

use super::*;

fn curve(terms: &[&[(f64, usize, usize)]], degree: usize) -> Result<PlaneCurve, Doubt> {
    let one = Extended::new(1.0, 700);
    let planes = terms
        .iter()
        .map(|terms| {
            let known = |x: f64| fuzzy::Fuzzy {
                value: one.constant(x),
                error: 1e-60,
            };
            let mut by_y: Vec<Vec<fuzzy::Fuzzy<Extended>>> = (0..=degree)
                .map(|j| vec![known(0.0); degree - j + 1])
                .collect();
            for (c, i, j) in terms.iter().filter(|(_, i, j)| i + j <= degree) {
                by_y[*j][*i] = known(*c);
            }
            Plane { by_y }
        })
        .collect();
    let curve = Curve::of(planes)?.ok_or(Doubt::Multiple)?;
    curve.branches(FINENESS, degree + GUARD, 700, |_| Ok(false))
}

fn shape(terms: &[&[(f64, usize, usize)]], degree: usize) -> (usize, Vec<usize>, bool) {
    let found = curve(terms, degree).unwrap_or_else(|doubt| panic!("{terms:?}: {doubt:?}"));
    let mut exponents: Vec<usize> = found
        .branches
        .iter()
        .filter_map(|branch| branch.ramification)
        .collect();
    exponents.sort_unstable();
    (found.branches.len(), exponents, found.tangential)
}

#[test]
fn branches_of_one_equation_are_paired() {
    type Case<'a> = (&'a str, &'a [(f64, usize, usize)], Vec<usize>, bool);
    let cases: [Case<'_>; 10] = [
        ("node", &[(1.0, 1, 1)], vec![1, 1], false),
        (
            "node of unlike slopes",
            &[(1.0, 0, 2), (-1.0, 1, 1), (1e-9, 2, 0)],
            vec![1, 1],
            false,
        ),
        ("cusp", &[(1.0, 0, 2), (-1.0, 3, 0)], vec![2], true),
        ("a7", &[(1.0, 0, 2), (-1.0, 8, 0)], vec![1, 1], true),
        ("e6", &[(1.0, 0, 3), (-1.0, 4, 0)], vec![3], true),
        (
            "small eight",
            &[(1.0, 0, 2), (-1e-6, 2, 0), (1.0, 4, 0)],
            vec![1, 1],
            false,
        ),
        (
            "isolated",
            &[(1.0, 0, 2), (1e-12, 2, 0), (-1.0, 4, 0)],
            vec![],
            true,
        ),
        (
            "line and cusp",
            &[(1.0, 1, 2), (-1.0, 4, 0)],
            vec![1, 2],
            false,
        ),
        (
            "two crossed cusps",
            &[(1.0, 2, 2), (-1.0, 5, 0), (-1.0, 0, 5), (1.0, 3, 3)],
            vec![2, 2],
            false,
        ),
        (
            "three parabolas",
            &[(1.0, 0, 3), (-1.0, 4, 1)],
            vec![1, 1, 1],
            true,
        ),
    ];
    for (name, terms, wanted, tangential) in cases {
        let (count, exponents, touching) = shape(&[terms], 14);
        assert_eq!((count, &exponents), (wanted.len(), &wanted), "{name}");
        assert_eq!(touching, tangential, "{name}");
    }
}

#[test]
fn points_of_a_branch_are_zeros_outside_the_origin() {
    // y² = x⁷, of which nothing shows in doubles at a thousandth.
    let terms: &[(f64, usize, usize)] = &[(1.0, 0, 2), (-1.0, 7, 0)];
    let found = curve(&[terms], 12).unwrap();
    let [branch] = found.branches.as_slice() else {
        panic!("{}", found.branches.len())
    };
    assert!(branch.points.len() > 20);
    for point in &branch.points {
        let [x, y] = [point[0], point[1]];
        assert!(
            (y * y - x.powi(7)).abs() < 1e-14 * x.abs().powi(2),
            "{point:?}"
        );
    }
    let [a, b] = [&branch.half_branches[0], &branch.half_branches[1]];
    assert!((a.tangent[0] - 1.0).abs() < 1e-12 && (b.tangent[0] - 1.0).abs() < 1e-12);
}

#[test]
fn only_what_is_common_to_all_equations_is_a_branch() {
    // x y = 0 and x (x + y²) = 0 have the line x = 0 in common.
    let (count, exponents, _) = shape(&[&[(1.0, 1, 1)], &[(1.0, 2, 0), (1.0, 1, 2)]], 12);
    assert_eq!((count, exponents), (1, vec![1]));
    // x y = 0 and x² − y² = 0 have nothing.
    let (count, ..) = shape(&[&[(1.0, 1, 1)], &[(1.0, 2, 0), (-1.0, 0, 2)]], 12);
    assert_eq!(count, 0);
    assert!(
        !curve(&[&[(1.0, 1, 1)], &[(1.0, 2, 0), (-1.0, 0, 2)]], 12)
            .unwrap()
            .sole
    );
}

#[test]
fn double_lines_stay_open_where_nothing_tells_that_they_are_one() {
    for terms in [
        vec![(1.0, 0, 2)],
        vec![(1.0, 1, 2)],
        vec![(1.0, 0, 2), (-2.0, 2, 1), (1.0, 4, 0)],
    ] {
        assert_eq!(curve(&[&terms], 12).err(), Some(Doubt::Multiple));
    }
}
