//! Tables of intersections and products of displacement subgroups, used as tests only.
//!
//! Every unordered pair of the twelve classes occurs, in general position and in each special one that
//! changes the result, after J. M. Hervé, "Analyse structurelle des mécanismes par groupe des déplacements",
//! Mech. Mach. Theory 13 (1978). The entries were worked out by hand from the geometry (which points, lines
//! and directions both subgroups keep) and not from the code under test.
//!
//! Printed entries checked separately: O. E. Ruiz (PhD thesis, Urbana 1994), tables 4.1 and 4.2.

use nalgebra::Vector3;
use proptest::prelude::*;

use super::*;
use DisplacementSubgroup as G;

const Z: Vector3<f64> = Vector3::new(0.0, 0.0, 1.0);
const X: Vector3<f64> = Vector3::new(1.0, 0.0, 0.0);
const SLANT: Vector3<f64> = Vector3::new(1.0, 0.0, 1.0);
const SKEW: Vector3<f64> = Vector3::new(2.0, 1.0, 2.0);
const P: f64 = 0.5;
const Q: f64 = -0.25;

fn unit(d: Vector3<f64>) -> Vector3<f64> {
    normalised_direction(d).unwrap_or_default()
}

fn line(point: [f64; 3], d: Vector3<f64>) -> Axis {
    let direction = unit(d);
    let point = Vector3::from(point);
    Axis {
        point: point - direction * direction.dot(&point),
        direction,
    }
}

/// The axis most rows use.
fn z0() -> Axis {
    line([1.0, 2.0, 0.0], Z)
}
/// Parallel to [`z0`], 3 m beside it.
fn z1() -> Axis {
    line([4.0, 2.0, 0.0], Z)
}
/// Meets [`z0`] at a right angle.
fn crossing() -> Axis {
    line([1.0, 2.0, 5.0], X)
}
/// Meets [`z0`] at 45°.
fn slanted() -> Axis {
    line([1.0, 2.0, -1.0], SLANT)
}
/// Skew to [`z0`].
fn skew() -> Axis {
    line([0.0, -3.0, 7.0], SKEW)
}

fn r(axis: Axis) -> G {
    G::Rotation { axis }
}
fn t(d: Vector3<f64>) -> G {
    G::Translation { direction: unit(d) }
}
fn h(axis: Axis, pitch: f64) -> G {
    G::Helical { axis, pitch }
}
fn c(axis: Axis) -> G {
    G::Cylindrical { axis }
}
fn t2(n: Vector3<f64>) -> G {
    G::PlanarTranslation { normal: unit(n) }
}
fn s(x: f64, y: f64, z: f64) -> G {
    let centre = Vector3::new(x, y, z);
    G::Spherical { centre }
}
fn g(n: Vector3<f64>) -> G {
    G::Planar { normal: unit(n) }
}
fn y(d: Vector3<f64>, pitch: f64) -> G {
    let direction = unit(d);
    G::TranslatingScrew { direction, pitch }
}
fn x(d: Vector3<f64>) -> G {
    G::Schoenflies { direction: unit(d) }
}
const E: G = G::Identity;
const T3: G = G::SpatialTranslation;
const D: G = G::General;

/// One subgroup of each class, in the order of [`SubgroupKind::ALL`].
pub(super) fn one_of_each() -> [G; 12] {
    [
        E,
        r(z0()),
        t(SKEW),
        h(z0(), P),
        c(skew()),
        t2(SKEW),
        s(1.0, -2.0, 3.0),
        g(Z),
        T3,
        y(Z, P),
        x(SLANT),
        D,
    ]
}

/// Two subgroups, their position, their intersection, and their product where that is a subgroup.
type Row = (G, G, &'static str, G, Option<G>);

#[rustfmt::skip]
fn rows() -> Vec<Row> {
    let on = s(1.0, 2.0, 4.0);
    let off = s(3.0, -1.0, 2.0);
    let normal_line = line([3.0, -1.0, 2.0], Z);
    let join = line([1.0, 2.0, 4.0], Vector3::new(2.0, -3.0, -2.0));
    let zxs = Z.cross(&SKEW);
    let mut rows = vec![
        (t(Z), t(Z), "equal", t(Z), Some(t(Z))),
        (t(Z), t(SKEW), "not parallel", E, Some(t2(zxs))),
        (t(Z), r(z0()), "parallel", E, Some(c(z0()))),
        (t(X), r(z0()), "normal", E, None),
        (t(SKEW), r(z0()), "oblique", E, None),
        (t(Z), h(z0(), P), "parallel", E, Some(c(z0()))),
        (t(X), h(z0(), P), "normal", E, None),
        (t(SKEW), h(z0(), P), "oblique", E, None),
        (t(Z), c(z0()), "parallel", t(Z), Some(c(z0()))),
        (t(X), c(z0()), "normal", E, None),
        (t(SKEW), c(z0()), "oblique", E, None),
        (t(X), t2(Z), "in the plane", t(X), Some(t2(Z))),
        (t(Z), t2(Z), "normal", E, Some(T3)),
        (t(SKEW), t2(Z), "oblique", E, Some(T3)),
        (t(SKEW), off, "any", E, None),
        (t(X), g(Z), "in the plane", t(X), Some(g(Z))),
        (t(Z), g(Z), "normal", E, Some(x(Z))),
        (t(SKEW), g(Z), "oblique", E, Some(x(Z))),
        (t(SKEW), T3, "any", t(SKEW), Some(T3)),
        (t(X), y(Z, P), "in the plane", t(X), Some(y(Z, P))),
        (t(Z), y(Z, P), "normal", E, Some(x(Z))),
        (t(SKEW), y(Z, P), "oblique", E, Some(x(Z))),
        (t(SKEW), x(Z), "any", t(SKEW), Some(x(Z))),

        (r(z0()), r(z0()), "equal", r(z0()), Some(r(z0()))),
        (r(z0()), r(z1()), "parallel", E, None),
        (r(z0()), r(crossing()), "meeting at a right angle", E, None),
        (r(z0()), r(slanted()), "meeting", E, None),
        (r(z0()), r(skew()), "skew", E, None),
        (r(z0()), h(z0(), P), "coaxial", E, Some(c(z0()))),
        (r(z0()), h(z1(), P), "parallel", E, None),
        (r(z0()), h(slanted(), P), "meeting", E, None),
        (r(z0()), h(skew(), P), "skew", E, None),
        (r(z0()), c(z0()), "coaxial", r(z0()), Some(c(z0()))),
        (r(z0()), c(z1()), "parallel", E, None),
        (r(z0()), c(crossing()), "meeting at a right angle", E, None),
        (r(z0()), c(skew()), "skew", E, None),
        (r(z0()), t2(Z), "axis normal to plane", E, Some(g(Z))),
        (r(z0()), t2(X), "axis in plane", E, None),
        (r(z0()), t2(SKEW), "oblique", E, None),
        (r(z0()), on, "axis through point", r(z0()), Some(on)),
        (r(z0()), off, "axis beside point", E, None),
        (r(z0()), g(Z), "axis normal to plane", r(z0()), Some(g(Z))),
        (r(z0()), g(X), "axis in plane", E, None),
        (r(z0()), g(SKEW), "oblique", E, None),
        (r(z0()), T3, "any", E, Some(x(Z))),
        (r(z0()), y(Z, P), "parallel", E, Some(x(Z))),
        (r(z0()), y(SKEW, P), "not parallel", E, None),
        (r(z0()), x(Z), "parallel", r(z0()), Some(x(Z))),
        (r(z0()), x(SKEW), "not parallel", E, None),

        (h(z0(), P), h(z0(), P), "equal", h(z0(), P), Some(h(z0(), P))),
        (h(z0(), P), h(z0(), Q), "coaxial, other pitch", E, Some(c(z0()))),
        (h(z0(), P), h(z0(), -P), "coaxial, other hand", E, Some(c(z0()))),
        (h(z0(), P), h(z1(), P), "parallel, same pitch", E, None),
        (h(z0(), P), h(z1(), Q), "parallel, other pitch", E, None),
        (h(z0(), P), h(crossing(), P), "meeting at a right angle", E, None),
        (h(z0(), P), h(skew(), P), "skew", E, None),
        (h(z0(), P), c(z0()), "coaxial", h(z0(), P), Some(c(z0()))),
        (h(z0(), P), c(z1()), "parallel", E, None),
        (h(z0(), P), c(skew()), "skew", E, None),
        (h(z0(), P), t2(Z), "axis normal to plane", E, Some(y(Z, P))),
        (h(z0(), P), t2(X), "axis in plane", E, None),
        (h(z0(), P), t2(SKEW), "oblique", E, None),
        (h(z0(), P), on, "axis through point", E, None),
        (h(z0(), P), off, "axis beside point", E, None),
        (h(z0(), P), g(Z), "axis normal to plane", E, Some(x(Z))),
        (h(z0(), P), g(X), "axis in plane", E, None),
        (h(z0(), P), T3, "any", E, Some(x(Z))),
        (h(z0(), P), y(Z, P), "parallel, same pitch", h(z0(), P), Some(y(Z, P))),
        (h(z0(), P), y(Z, Q), "parallel, other pitch", E, Some(x(Z))),
        (h(z0(), P), y(SKEW, P), "not parallel", E, None),
        (h(z0(), P), x(Z), "parallel", h(z0(), P), Some(x(Z))),
        (h(z0(), P), x(SKEW), "not parallel", E, None),

        (c(z0()), c(z0()), "equal", c(z0()), Some(c(z0()))),
        (c(z0()), c(z1()), "parallel", t(Z), None),
        (c(z0()), c(crossing()), "meeting at a right angle", E, None),
        (c(z0()), c(slanted()), "meeting", E, None),
        (c(z0()), c(skew()), "skew", E, None),
        (c(z0()), t2(Z), "axis normal to plane", E, Some(x(Z))),
        (c(z0()), t2(X), "axis in plane", t(Z), None),
        (c(z0()), t2(SKEW), "oblique", E, Some(x(Z))),
        (c(z0()), on, "axis through point", r(z0()), None),
        (c(z0()), off, "axis beside point", E, None),
        (c(z0()), g(Z), "axis normal to plane", r(z0()), Some(x(Z))),
        (c(z0()), g(X), "axis in plane", t(Z), None),
        (c(z0()), g(SKEW), "oblique", E, None),
        (c(z0()), T3, "any", t(Z), Some(x(Z))),
        (c(z0()), y(Z, P), "parallel", h(z0(), P), Some(x(Z))),
        (c(z0()), y(X, P), "axis in plane", t(Z), None),
        (c(z0()), y(SKEW, P), "oblique", E, None),
        (c(z0()), x(Z), "parallel", c(z0()), Some(x(Z))),
        (c(z0()), x(SKEW), "not parallel", t(Z), None),

        (t2(Z), t2(Z), "equal", t2(Z), Some(t2(Z))),
        (t2(Z), t2(SKEW), "not parallel", t(zxs), Some(T3)),
        (t2(Z), off, "any", E, None),
        (t2(Z), g(Z), "parallel planes", t2(Z), Some(g(Z))),
        (t2(SKEW), g(Z), "not parallel", t(zxs), Some(x(Z))),
        (t2(Z), T3, "any", t2(Z), Some(T3)),
        (t2(Z), y(Z, P), "parallel planes", t2(Z), Some(y(Z, P))),
        (t2(SKEW), y(Z, P), "not parallel", t(zxs), Some(x(Z))),
        (t2(Z), x(Z), "normal along direction", t2(Z), Some(x(Z))),
        (t2(SKEW), x(Z), "any", t2(SKEW), Some(x(Z))),

        (on, on, "equal", on, Some(on)),
        (on, off, "two points", r(join), None),
        (off, g(Z), "any", r(normal_line), None),
        (off, T3, "any", E, Some(D)),
        (off, y(Z, P), "any", E, Some(D)),
        (off, x(Z), "any", r(normal_line), Some(D)),

        (g(Z), g(Z), "equal", g(Z), Some(g(Z))),
        (g(Z), g(X), "normal planes (Sarrus)", t(Z.cross(&X)), None),
        (g(Z), g(SKEW), "not parallel", t(zxs), None),
        (g(Z), T3, "any", t2(Z), Some(x(Z))),
        (g(Z), y(Z, P), "parallel planes", t2(Z), Some(x(Z))),
        (g(Z), y(SKEW, P), "not parallel", t(zxs), None),
        (g(Z), x(Z), "same direction", g(Z), Some(x(Z))),
        (g(Z), x(SKEW), "other direction", t2(Z), None),

        (T3, T3, "equal", T3, Some(T3)),
        (T3, y(Z, P), "any", t2(Z), Some(x(Z))),
        (T3, x(Z), "any", T3, Some(x(Z))),

        (y(Z, P), y(Z, P), "equal", y(Z, P), Some(y(Z, P))),
        (y(Z, P), y(Z, Q), "other pitch", t2(Z), Some(x(Z))),
        (y(Z, P), y(Z, -P), "other hand", t2(Z), Some(x(Z))),
        (y(Z, P), y(SKEW, P), "other direction", t(zxs), None),
        (y(Z, P), x(Z), "same direction", y(Z, P), Some(x(Z))),
        (y(Z, P), x(SKEW), "other direction", t2(Z), None),

        (x(Z), x(Z), "equal", x(Z), Some(x(Z))),
        (x(Z), x(SKEW), "other direction", T3, None),
    ];
    for one in one_of_each() {
        rows.push((E, one, "any", E, Some(one)));
        rows.push((D, one, "any", one, Some(D)));
    }
    rows
}

fn gauge() -> Result<Gauge, GroupError> {
    Gauge::new(Vector3::new(0.5, 0.0, 1.0), 3.0, 1e-9)
}

/// A mechanism moved as a whole and measured in another unit: one of these is `unit` metres.
#[derive(Clone, Copy, Debug)]
struct View {
    pose: Pose,
    unit: f64,
}

impl View {
    const PLAIN: fn() -> Self = || Self {
        pose: Pose::identity(),
        unit: 1.0,
    };

    fn twists(&self, group: &G) -> Vec<Twist> {
        let seen = |twist: &Twist| {
            let moved = self.pose.transform_twist(twist);
            // A translation per metre stays a unit; a length per radian is counted in the new unit.
            Twist::new(moved.angular, moved.linear * self.unit)
        };
        group.algebra().iter().map(seen).collect()
    }

    fn gauge(&self) -> Result<Gauge, GroupError> {
        let plain = gauge()?;
        let centre = self.pose.transform_point(&plain.centre()) * self.unit;
        // Coordinates 1000 lengths from the origin carry 1e-13 of rounding: far inside 1e-9.
        Gauge::new(centre, plain.length() * self.unit, plain.tolerance())
    }

    fn algebra(&self, group: &G) -> Result<Subalgebra, GroupError> {
        let system = ScrewSystem::span(&self.twists(group), &self.gauge()?)?;
        let algebra = Subalgebra::from_system(&system)?;
        assert!(algebra.is_some(), "{group}: not closed under the bracket");
        Ok(algebra.unwrap_or(Subalgebra::generated_by_system(&system)?))
    }

    /// `found` must be `expected` as seen from here.
    fn assert_is(&self, found: &Subalgebra, expected: &G, what: &str) -> Result<(), GroupError> {
        let classified = found.subgroup()?;
        let name = classified.map(|g| g.short_name());
        assert_eq!(name, Some(expected.short_name()), "{what}");
        let expected_algebra = self.algebra(expected)?;
        let same = found.system().same_as(expected_algebra.system())?;
        assert!(same, "{what}: another {}", expected.short_name());
        assert!(found.margin().is_clear(), "{what}: {:?}", found.margin());
        // The geometry that was read off generates the same space.
        if let Some(group) = classified {
            let system = ScrewSystem::span(&group.algebra(), &self.gauge()?)?;
            assert!(system.same_as(found.system())?, "{what}: geometry {group}");
        }
        Ok(())
    }

    fn assert_row(&self, (a, b, position, meet, product): &Row) -> Result<(), GroupError> {
        let what = format!("{} and {}, {position}", a.short_name(), b.short_name());
        let (first, second) = (self.algebra(a)?, self.algebra(b)?);
        for (p, q) in [(&first, &second), (&second, &first)] {
            let meeting = p.intersection(q)?;
            self.assert_is(&meeting, meet, &format!("intersection of {what}"))?;
            let sum = p.sum(q)?;
            assert_eq!(
                sum.dimension() + meeting.dimension(),
                p.dimension() + q.dimension(),
                "{what}"
            );
            let (closed, margin) = product_is_subgroup(p, q)?;
            assert_eq!(closed, product.is_some(), "product of {what}");
            assert!(margin.is_clear(), "product of {what}: {margin:?}");
            if let Some(product) = product {
                let join = p.join(q)?;
                self.assert_is(&join, product, &format!("product of {what}"))?;
                assert_eq!(join.dimension(), sum.dimension(), "{what}");
            }
        }
        Ok(())
    }
}

#[test]
fn all_intersections_and_products() -> Result<(), GroupError> {
    let view = View::PLAIN();
    rows().iter().try_for_each(|row| view.assert_row(row))
}

#[test]
fn every_pair_of_classes_is_in_the_table() {
    for (i, a) in SubgroupKind::ALL.iter().enumerate() {
        for b in &SubgroupKind::ALL[i..] {
            let found = rows().iter().any(|(p, q, ..)| {
                let pair = (p.kind(), q.kind());
                pair == (*a, *b) || pair == (*b, *a)
            });
            assert!(found, "{a:?} with {b:?}");
        }
    }
}

/// Table 4.2 of the thesis: the product of two parallel cylinders is printed as C·R, with the second axis;
/// as sets of displacements the two agree because their tangent spaces do: both have dimension 3, and the
/// translation of the second cylinder is already in the first.
#[test]
fn parallel_cylinders_compose_like_cylinder_and_rotation() -> Result<(), GroupError> {
    let view = View::PLAIN();
    let (first, second) = (view.algebra(&c(z0()))?, view.algebra(&c(z1()))?);
    let both = first.sum(&second)?;
    let printed = first.sum(&view.algebra(&r(z1()))?)?;
    assert_eq!(both.dimension(), 3);
    assert!(both.same_as(&printed)?);
    view.assert_is(&first.intersection(&second)?, &t(Z), "printed intersection")
}

/// Table 4.2 of the thesis gives for two planar translations the intersection T along the common line and
/// the product T3, and leaves the column for the condition empty. Planes that are not parallel are
/// meant: for parallel ones the intersection is T2, of dimension 2, and the product T2 again.
#[test]
fn planar_translations_need_the_unprinted_condition() -> Result<(), GroupError> {
    let view = View::PLAIN();
    let plane = view.algebra(&t2(Z))?;
    let tilted = view.algebra(&t2(SKEW))?;
    view.assert_is(&plane.intersection(&tilted)?, &t(Z.cross(&SKEW)), "printed")?;
    view.assert_is(&plane.join(&tilted)?, &T3, "printed")?;
    view.assert_is(&plane.intersection(&plane)?, &t2(Z), "parallel planes")?;
    view.assert_is(&plane.join(&plane)?, &t2(Z), "parallel planes")
}

/// Table 4.1 of the thesis writes H as trans(x,0,0) twix(px) and Y as trans(x,y,z) twix(px): there p is an angle
/// per length. Taking that p for a length per angle would give another group: its algebra is not ours.
#[test]
fn printed_pitch_is_the_reciprocal_of_ours() -> Result<(), GroupError> {
    let printed = |x: f64, p: f64| Pose::translation(X * x) * Pose::rotation_about(X, p * x);
    let axis = line([0.0; 3], X);
    let gauge = gauge()?;
    let system = ScrewSystem::span(&h(axis, P).algebra(), &gauge)?;
    assert!(system.contains(&printed(0.3, 1.0 / P).log()));
    assert!(!system.contains(&printed(0.3, P).log()));
    Ok(())
}

fn any_view() -> impl Strategy<Value = View> {
    let range = |r: f64| [-r..r, -r..r, -r..r].prop_map(Vector3::from);
    (range(2.0), range(1.0), 0.0..3.5_f64, -6.0..6.0_f64).prop_map(
        |(turn, direction, distance, exponent)| View {
            pose: Pose::translation(direction * 10.0_f64.powf(distance))
                * Pose::exp(&Twist::new(turn, Vector3::zeros())),
            unit: 10.0_f64.powf(exponent),
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn tables_hold_wherever_the_origin_and_whatever_the_unit(view in any_view()) {
        for row in rows() {
            let outcome = view.assert_row(&row);
            prop_assert!(outcome.is_ok(), "{outcome:?}");
        }
    }
}
