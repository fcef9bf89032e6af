//! What a joint can do, in polynomial variables: (c, s) on a circle for a turn, a coordinate for a slide, a unit
//! quaternion for a ball.
//!
//! A turn about an axis a of any length has the variables c = cos θ and s = sin θ/|a| with c² + |a|² s² = 1; a slide along
//! a direction d moves by x·d. So no square root is needed for an axis such as (1 1 1).

use super::element::Element;
use super::field::Field;
use super::model::{Axis, JointModel};
use super::poly::Poly;
use super::space::{
    Matrix, Polynomials, Pose, Scalars, Vector, apply, cross, dot, matrix, multiply, negate, pose,
    rotation, rotation_of_quaternion, scale, subtract, transpose, vector,
};
use super::variables::{Meaning, Names};
use kutzbach_model::mechanism::{Joint, JointId, JointKind};

/// One step of a displacement.
#[derive(Clone, Debug)]
pub(super) enum Factor {
    Constant(Matrix<Element>),
    Turn {
        axis: Axis,
        cosine: usize,
        sine: usize,
    },
    Slide {
        along: Vector<Element>,
        way: usize,
    },
    Ball([usize; 4]),
}

/// A joint's variables and its displacement in them.
#[derive(Clone, Debug)]
pub(super) struct Displacement {
    pub(super) factors: Vec<Factor>,
    /// Its variables, in order.
    pub(super) variables: Vec<usize>,
    /// Circles, unit quaternions, fixed lengths: equations of its own.
    pub(super) own: Vec<Poly>,
    /// Cosine, sine and axis of the joint's single turn, for couplings.
    pub(super) turn: Option<(usize, usize, Axis)>,
    /// The variable and squared unit of its single slide, for couplings.
    pub(super) slide: Option<(usize, Element)>,
}

/// Makes a joint's variables.
struct Maker<'a> {
    field: &'a Field,
    names: &'a mut Names,
    joint: &'a Joint,
    id: JointId,
    result: Displacement,
}

impl Maker<'_> {
    fn freedom_name(&self, freedom: Option<usize>, other: &str) -> String {
        match freedom {
            Some(index) => self.joint.freedom_name(index),
            None => format!("{}.{other}", self.joint.name),
        }
    }

    fn turn(&mut self, axis: &Axis, freedom: Option<usize>) {
        let name = self.freedom_name(freedom, "rot");
        let cosine = self.names.add(
            format!("cos({name})"),
            Meaning::Cosine {
                joint: self.id,
                freedom,
            },
        );
        let letter = if axis.is_unit() { "sin" } else { "s" };
        let sine = self.names.add(
            format!("{letter}({name})"),
            Meaning::Sine {
                joint: self.id,
                freedom,
                axis_square: self.field.number(&axis.square),
            },
        );
        let ring = Polynomials(self.field);
        let [c, s] = [cosine, sine].map(Poly::variable);
        let squares = ring.plus(
            &ring.times(&c, &c),
            &ring.times(&s, &s).scaled(&axis.square, self.field),
        );
        self.result.own.push(ring.minus(&squares, &ring.integer(1)));
        self.result.variables.extend([cosine, sine]);
        self.result.turn = Some((cosine, sine, axis.clone()));
        self.result.factors.push(Factor::Turn {
            axis: axis.clone(),
            cosine,
            sine,
        });
    }

    fn slide(&mut self, along: &Vector<Element>, square: &Element, freedom: Option<usize>) {
        let name = self.freedom_name(freedom, "trans");
        let unit = *square == Element::integer(1);
        let way = self.names.add(
            if unit { name } else { format!("t({name})") },
            Meaning::Translation {
                joint: self.id,
                freedom,
                unit_square: self.field.number(square),
            },
        );
        self.result.variables.push(way);
        self.result.slide = Some((way, square.clone()));
        self.result.factors.push(Factor::Slide {
            along: along.clone(),
            way,
        });
    }

    fn slides_across(&mut self, axis: &Axis, first: usize) {
        for (index, across) in axis.across.iter().enumerate() {
            self.slide(&across.direction, &across.square, Some(first + index));
        }
    }

    fn slides_everywhere(&mut self, freedoms: [Option<usize>; 3]) {
        for (i, freedom) in freedoms.into_iter().enumerate() {
            let along = [0, 1, 2].map(|j| Element::integer(i64::from(i == j)));
            self.slide(&along, &Element::integer(1), freedom);
        }
    }

    fn ball(&mut self, start: Matrix<Element>) {
        let ring = Polynomials(self.field);
        let q = [0, 1, 2, 3].map(|component| {
            self.names.add(
                format!("{}.q{component}", self.joint.name),
                Meaning::Quaternion {
                    joint: self.id,
                    component,
                },
            )
        });
        let squares = q.iter().fold(Poly::default(), |sum, &i| {
            let x = Poly::variable(i);
            ring.plus(&sum, &ring.times(&x, &x))
        });
        self.result.own.push(ring.minus(&squares, &ring.integer(1)));
        self.result.variables.extend(q);
        self.result.factors.push(Factor::Constant(start));
        self.result.factors.push(Factor::Ball(q));
    }

    fn rod(&mut self, distance_square: &Element) {
        let ring = Polynomials(self.field);
        let mut squares = Poly::default();
        for component in 0..3 {
            let letter = ["x", "y", "z"][component];
            let way = self.names.add(
                format!("{}.{letter}", self.joint.name),
                Meaning::Between {
                    joint: self.id,
                    component,
                },
            );
            let x = Poly::variable(way);
            squares = ring.plus(&squares, &ring.times(&x, &x));
            self.result.variables.push(way);
            let along = [0, 1, 2].map(|j| Element::integer(i64::from(component == j)));
            self.result.factors.push(Factor::Slide { along, way });
        }
        let equation = ring.minus(&squares, &Poly::constant(distance_square.clone()));
        self.result.own.push(equation);
    }
}

impl Displacement {
    /// A joint without variables of its own.
    pub(super) fn none() -> Self {
        Self {
            factors: Vec::new(),
            variables: Vec::new(),
            own: Vec::new(),
            turn: None,
            slide: None,
        }
    }

    /// A joint's variables and displacement. Screws are relaxed: the two screw kinds turn and travel independently.
    pub(super) fn new(
        field: &Field,
        names: &mut Names,
        joint: &Joint,
        id: JointId,
        model: &JointModel,
    ) -> Self {
        let mut maker = Maker {
            field,
            names,
            joint,
            id,
            result: Self::none(),
        };
        let start = || model.ball_start(field);
        match (model.kind, &model.axis, &model.axis2) {
            (JointKind::Revolute, Some(a), _) => maker.turn(a, Some(0)),
            (JointKind::Prismatic, Some(a), _) => maker.slide(&a.direction, &a.square, Some(0)),
            (JointKind::Screw, Some(a), _) => {
                maker.slide(&a.direction, &a.square, None);
                maker.turn(a, Some(0));
            }
            (JointKind::Cylindrical, Some(a), _) => {
                maker.slide(&a.direction, &a.square, Some(0));
                maker.turn(a, Some(1));
            }
            (JointKind::Universal, Some(a), Some(b)) => {
                maker.turn(a, Some(0));
                maker.turn(b, Some(1));
            }
            (JointKind::PlanarTranslation, Some(a), _) => maker.slides_across(a, 0),
            (JointKind::Planar, Some(a), _) => {
                maker.slides_across(a, 0);
                maker.turn(a, Some(2));
            }
            (JointKind::Spherical, ..) => maker.ball(start()),
            (JointKind::Translational, ..) => {
                maker.slides_everywhere([Some(0), Some(1), Some(2)]);
            }
            (JointKind::TranslatingScrew, Some(a), _) => {
                maker.slides_across(a, 0);
                maker.slide(&a.direction, &a.square, None);
                maker.turn(a, Some(2));
            }
            (JointKind::Schoenflies, Some(a), _) => {
                maker.slides_everywhere([Some(0), Some(1), Some(2)]);
                maker.turn(a, Some(3));
            }
            (JointKind::PointOnLine, _, Some(b)) => {
                maker.ball(start());
                maker.slide(&b.direction, &b.square, Some(3));
            }
            (JointKind::PointOnPlane, _, Some(b)) => {
                maker.ball(start());
                maker.slides_across(b, 3);
            }
            (JointKind::LineOnPlane, Some(a), Some(b)) => {
                maker.turn(a, Some(0));
                if let Some(constant) = &model.into_plane {
                    maker
                        .result
                        .factors
                        .push(Factor::Constant(constant.clone()));
                }
                maker.slides_across(b, 1);
                maker.turn(b, Some(3));
            }
            (JointKind::Distance, ..) => {
                maker.rod(&model.distance_square.clone().unwrap_or_default());
                maker.ball(start());
            }
            // Nothing moves; a kind without the axis it uses does not exist.
            _ => {}
        }
        maker.result
    }

    /// Goes on from a pose through the joint, from link to link.
    pub(super) fn pass(
        &self,
        field: &Field,
        model: &JointModel,
        from: &Pose<Poly>,
        forward: bool,
    ) -> Pose<Poly> {
        let ring = Polynomials(field);
        let [first, last] = if forward { [0, 1] } else { [1, 0] };
        let mut place = from.then(&ring, &pose(&ring, &model.sides[first]));
        let mut step = |factor: &Factor| match factor {
            Factor::Slide { along, way } => {
                let way = Poly::variable(*way);
                let moved = scale(&ring, &vector(&ring, along), &way);
                let moved = if forward {
                    moved
                } else {
                    negate(&ring, &moved)
                };
                place.translation = place.image(&ring, &moved);
            }
            other => {
                let turn = factor_rotation(&ring, field, other);
                let turn = if forward { turn } else { transpose(&turn) };
                place.rotation = multiply(&ring, &place.rotation, &turn);
            }
        };
        if forward {
            self.factors.iter().for_each(&mut step);
        } else {
            self.factors.iter().rev().for_each(&mut step);
        }
        // The constant frame is inverted before it meets a polynomial: that keeps degrees down.
        let back = model.sides[last].inverse(field);
        place.then(&ring, &pose(&ring, &back))
    }
}

fn factor_rotation(ring: &Polynomials<'_>, field: &Field, factor: &Factor) -> Matrix<Poly> {
    match factor {
        Factor::Constant(constant) => matrix(ring, constant),
        Factor::Turn { axis, cosine, sine } => rotation(
            ring,
            &axis.direction,
            &axis.inverse_square,
            &Poly::variable(*cosine),
            &Poly::variable(*sine),
            field,
        ),
        Factor::Ball(q) => rotation_of_quaternion(ring, &q.map(Poly::variable)),
        Factor::Slide { .. } => super::space::identity(ring),
    }
}

/// The values of a joint's variables, in order, where the successor's joint frame stands at a pose in the predecessor's;
/// those of a pose near by where the joint cannot reach it. `None` where a ball's quaternion cannot be told exactly.
pub(super) fn values_at<S: Scalars>(
    s: &S,
    field: &Field,
    model: &JointModel,
    relative: &Pose<S::Value>,
) -> Option<Vec<S::Value>> {
    let r = &relative.rotation;
    let t = &relative.translation;
    let fraction =
        |numerator: &S::Value, inverse: &Element| s.times(numerator, &s.constant(inverse));
    let along = |v: &Vector<S::Value>, d: &Vector<Element>, inverse: &Element| {
        fraction(&dot(s, v, &vector(s, d)), inverse)
    };
    let across = |v: &Vector<S::Value>, axis: &Axis| {
        [0, 1].map(|i| {
            let e = &axis.across[i];
            along(v, &e.direction, &e.inverse_square)
        })
    };
    // R = c I + s [a] + ...: the trace is 1 + 2c, the antisymmetric part s a.
    let half = Element::rational(super::fraction::fraction(1, 2));
    let turn = |r: &Matrix<S::Value>, axis: &Axis| {
        let trace = s.plus(&s.plus(&r[0][0], &r[1][1]), &r[2][2]);
        let cosine = fraction(&s.minus(&trace, &s.integer(1)), &half);
        let twice = [
            s.minus(&r[2][1], &r[1][2]),
            s.minus(&r[0][2], &r[2][0]),
            s.minus(&r[1][0], &r[0][1]),
        ];
        let sine = along(&twice, &axis.direction, &axis.inverse_square);
        [cosine, fraction(&sine, &half)]
    };
    let ball = |r: &Matrix<S::Value>| {
        let start = transpose(&matrix(s, &model.ball_start(field)));
        s.quaternion(&multiply(s, &start, r))
    };
    let mut values = Vec::new();
    match (model.kind, &model.axis, &model.axis2) {
        (JointKind::Revolute, Some(a), _) => values.extend(turn(r, a)),
        (JointKind::Prismatic, Some(a), _) => {
            values.push(along(t, &a.direction, &a.inverse_square));
        }
        (JointKind::Screw | JointKind::Cylindrical, Some(a), _) => {
            values.push(along(t, &a.direction, &a.inverse_square));
            values.extend(turn(r, a));
        }
        (JointKind::Universal, Some(a), Some(b)) => {
            let Some(skew) = &model.skew else {
                // One axis: which of the two turns is not told by the pose.
                values.extend(turn(r, a));
                values.extend([s.integer(1), s.integer(0)]);
                return Some(values);
            };
            let (u, v) = (vector(s, &a.direction), vector(s, &b.direction));
            let mixed = dot(field, &a.direction, &b.direction);
            let mixed_square = s.constant(&field.square(&mixed));
            // Turned by the first angle, b goes to R b; turned back by the second, a goes to Rᵀ a.
            let image = apply(s, r, &v);
            let back = apply(s, &transpose(r), &u);
            let cosine = |square: &Element, from: &Vector<S::Value>, to: &Vector<S::Value>| {
                let product = fraction(&dot(s, from, to), square);
                fraction(&s.minus(&product, &mixed_square), skew)
            };
            values.push(cosine(&a.square, &v, &image));
            values.push(fraction(&dot(s, &u, &cross(s, &v, &image)), skew));
            values.push(cosine(&b.square, &u, &back));
            values.push(fraction(&dot(s, &v, &cross(s, &back, &u)), skew));
        }
        (JointKind::PlanarTranslation, Some(a), _) => values.extend(across(t, a)),
        (JointKind::Planar, Some(a), _) => {
            values.extend(across(t, a));
            values.extend(turn(r, a));
        }
        (JointKind::Spherical, ..) => values.extend(ball(r)?),
        (JointKind::Translational, ..) => values.extend(t.iter().cloned()),
        (JointKind::TranslatingScrew, Some(a), _) => {
            values.extend(across(t, a));
            values.push(along(t, &a.direction, &a.inverse_square));
            values.extend(turn(r, a));
        }
        (JointKind::Schoenflies, Some(a), _) => {
            values.extend(t.iter().cloned());
            values.extend(turn(r, a));
        }
        (JointKind::PointOnLine | JointKind::PointOnPlane, _, Some(b)) => {
            values.extend(ball(r)?);
            let behind = apply(s, &transpose(r), t);
            if model.kind == JointKind::PointOnLine {
                values.push(along(&behind, &b.direction, &b.inverse_square));
            } else {
                values.extend(across(&behind, b));
            }
        }
        (JointKind::LineOnPlane, Some(a), Some(b)) => {
            let constant = matrix(s, model.into_plane.as_ref()?);
            let normal = apply(s, &constant, &vector(s, &b.direction));
            let image = apply(s, r, &vector(s, &b.direction));
            let cosine = fraction(&dot(s, &normal, &image), &b.inverse_square);
            let triple = dot(s, &vector(s, &a.direction), &cross(s, &normal, &image));
            let sine = fraction(&fraction(&triple, &b.inverse_square), &a.inverse_square);
            let first = rotation(s, &a.direction, &a.inverse_square, &cosine, &sine, field);
            let back = transpose(&multiply(s, &first, &constant));
            values.extend([cosine, sine]);
            values.extend(across(&apply(s, &back, t), b));
            values.extend(turn(&multiply(s, &back, r), b));
        }
        (JointKind::Distance, ..) => {
            values.extend(t.iter().cloned());
            values.extend(ball(r)?);
        }
        _ => {}
    }
    Some(values)
}

/// The pose of a successor's joint frame in the predecessor's from two link poses.
pub(super) fn relative<S: Scalars>(
    s: &S,
    model: &JointModel,
    predecessor: &Pose<S::Value>,
    successor: &Pose<S::Value>,
) -> Pose<S::Value> {
    let [first, second] = [0, 1].map(|i| pose(s, &model.sides[i]));
    let first = predecessor.then(s, &first);
    let second = successor.then(s, &second);
    let back = transpose(&first.rotation);
    Pose {
        rotation: multiply(s, &back, &second.rotation),
        translation: apply(
            s,
            &back,
            &subtract(s, &second.translation, &first.translation),
        ),
    }
}
