//! Sketches as files have them: names, circles, and elements that follow from others.

use crate::construction::Shape;
use crate::relation::{Relation, measured};
use crate::sketch::{Constraint, Sketch, SketchError};
use kutzbach_math::number::Number;

/// How large a circle is.
#[derive(Clone, Debug)]
pub enum Radius {
    /// As stated.
    Known(Number),
    /// An unknown value of the relations, by index.
    Unknown(usize),
}

/// A circle around a point of a sketch. What it does to other elements is said by constraints and relations of its centre.
#[derive(Clone, Debug)]
pub struct Circle {
    /// What it is called.
    pub name: String,
    /// The point in its centre.
    pub centre: usize,
    /// How large it is.
    pub radius: Radius,
}

/// A sketch as a file has it.
#[derive(Clone, Debug)]
pub struct NamedSketch {
    /// What it is called.
    pub name: String,
    /// What its elements are called, by index: those of the sketch, then those that follow from them.
    pub names: Vec<String>,
    /// The elements and constraints.
    pub sketch: Sketch,
    /// Relations that say where one further element each is and take no part otherwise, in the order in which they place theirs.
    pub follow: Vec<Relation>,
    /// Relations that say no more than what an unknown value is.
    pub sizes: Vec<Relation>,
    /// The circles.
    pub circles: Vec<Circle>,
}

impl NamedSketch {
    /// A sketch without circles and relations. Names by element.
    #[must_use]
    pub const fn new(name: String, names: Vec<String>, sketch: Sketch) -> Self {
        Self {
            name,
            names,
            sketch,
            follow: Vec::new(),
            sizes: Vec::new(),
            circles: Vec::new(),
        }
    }

    /// The same of a sketch as it was read, where elements that one relation places by others and that nothing else mentions are no
    /// part of the sketch any more, and values that nothing else needs are no unknowns: what is left is smaller, and may be
    /// constructed step by step.
    ///
    /// # Errors
    /// Those of [`Sketch::new`] and [`Sketch::with_relations`]; none for what was a sketch before.
    pub fn without_what_follows(mut self) -> Result<Self, SketchError> {
        let sketch = &self.sketch;
        let taken = Taken::off(sketch);
        let count = sketch.elements().len();
        let follows = |e: &usize| taken.last.iter().any(|(l, _)| l == e);
        let kept: Vec<usize> = (0..count).filter(|e| !follows(e)).collect();
        let elements = kept.iter().map(|&e| sketch.elements()[e]).collect();
        let place = places(
            kept.into_iter().chain(taken.last.iter().map(|l| l.0)),
            count,
        );
        let needed = |v: &usize| {
            taken
                .left
                .iter()
                .flat_map(|r| r.values())
                .any(|t| t.0 == *v)
        };
        let (used, unused): (Vec<usize>, Vec<usize>) =
            (0..sketch.unknown_values()).partition(needed);
        let count_used = used.len();
        let value_at = places(used.into_iter().chain(unused), sketch.unknown_values());
        let moved = |r: &Relation| r.moved(|e| Some(place[e]), |v| Some(value_at[v]));
        let constraints = sketch.constraints().iter().map(|c| Constraint {
            ends: c.ends.map(|e| place[e]),
            value: c.value.clone(),
        });
        let rigid = sketch.rigid_triangles().into_iter();
        let rigid = rigid.map(|(three, places)| (three.map(|e| place[e]), places));
        let smaller = Sketch::new(elements, constraints.collect())?
            .with_rigid(rigid.collect())
            .with_relations(taken.left.iter().filter_map(moved).collect(), count_used)?;
        let smaller = match sketch.senses_count() {
            true => smaller,
            false => smaller.of_figures(),
        };
        let mut names = vec![String::new(); count];
        for (name, &at) in self.names.iter().zip(&place) {
            names[at].clone_from(name);
        }
        for circle in &mut self.circles {
            circle.centre = place[circle.centre];
            if let Radius::Unknown(value) = &mut circle.radius {
                *value = value_at[*value];
            }
        }
        self.follow = taken.last.iter().filter_map(|(_, r)| moved(r)).collect();
        self.sizes = taken.sizes.iter().filter_map(moved).collect();
        self.names = names;
        self.sketch = smaller;
        Ok(self)
    }

    /// What a relation says, in words.
    #[must_use]
    pub fn told(&self, relation: &Relation) -> String {
        let name = |e: usize| &*self.names[e];
        match *relation {
            Relation::Middle { point, of: [a, b] } => {
                format!("{} in the middle of {} {}", name(point), name(a), name(b))
            }
            Relation::Mirrored {
                pair: [a, b], axis, ..
            } => format!("{} {} symmetric about {}", name(a), name(b), name(axis)),
            Relation::Measured { ends: [a, b], .. } => {
                format!("{} {} by a length that others have too", name(a), name(b))
            }
        }
    }

    /// What a constraint says, or, beyond these, a relation.
    #[must_use]
    pub fn statement(&self, edge: usize) -> String {
        let constraints = self.sketch.constraints();
        match constraints.get(edge) {
            Some(constraint) => constraint.ends.map(|e| &*self.names[e]).join(" "),
            None => {
                let relation = self.sketch.relations().get(edge - constraints.len());
                relation.map_or_else(String::new, |r| self.told(r))
            }
        }
    }

    /// Points and lines, what is said of them, and circles, for a heading.
    #[must_use]
    pub fn size(&self) -> String {
        let sketch = &self.sketch;
        let said = sketch.constraints().len() + sketch.relations().len();
        let said = said + self.follow.len() + self.sizes.len();
        let circles = match self.circles.len() {
            0 => String::new(),
            1 => ", 1 circle".to_owned(),
            many => format!(", {many} circles"),
        };
        format!("{} elements{circles}, {said} constraints", self.names.len())
    }

    /// The places of all elements, where those of the sketch are these.
    #[must_use]
    pub fn whole(&self, shapes: &[Shape]) -> Vec<Shape> {
        let mut all = shapes.to_vec();
        for relation in &self.follow {
            let Some(shape) = relation.place(all.len(), &all) else {
                break;
            };
            all.push(shape);
        }
        all
    }

    /// The radius of every circle, where all elements are in these places; `None` where nothing says it.
    #[must_use]
    pub fn radii(&self, all: &[Shape]) -> Vec<Option<f64>> {
        let relations = self.sketch.relations().iter().chain(&self.sizes);
        let values = self.circles.iter().filter_map(|c| match c.radius {
            Radius::Unknown(value) => Some(value + 1),
            Radius::Known(_) => None,
        });
        let values = measured(relations, all, values.max().unwrap_or(0).max(self.values()));
        let radius = |circle: &Circle| match &circle.radius {
            Radius::Known(number) => Some(number.value()),
            Radius::Unknown(value) => values.get(*value).copied().filter(|v| !v.is_nan()),
        };
        self.circles.iter().map(radius).collect()
    }

    /// One more than the largest index of an unknown value.
    fn values(&self) -> usize {
        let relations = self.sketch.relations().iter().chain(&self.sizes);
        let largest = relations.flat_map(|r| r.values()).map(|t| t.0 + 1).max();
        largest.unwrap_or(0)
    }
}

/// Where each of `0..count` stands in this order of all of them.
fn places(order: impl Iterator<Item = usize>, count: usize) -> Vec<usize> {
    let mut place = vec![0; count];
    order.enumerate().for_each(|(at, i)| place[i] = at);
    place
}

/// Relations taken off a sketch one after the other, as far as each says one thing only.
struct Taken {
    /// Elements that a relation places, in the order in which they can be placed.
    last: Vec<(usize, Relation)>,
    /// What says what a value is that occurs nowhere else.
    sizes: Vec<Relation>,
    /// All others.
    left: Vec<Relation>,
}

impl Taken {
    fn off(sketch: &Sketch) -> Self {
        let mut taken = Self {
            last: Vec::new(),
            sizes: Vec::new(),
            left: sketch.relations().to_vec(),
        };
        let mut mentioned = vec![0_usize; sketch.elements().len()];
        let constrained = sketch.constraints().iter().flat_map(|c| c.ends);
        let related = sketch.relations().iter().flat_map(Relation::elements);
        for e in constrained.chain(related) {
            mentioned[e] += 1;
        }
        // A sketch has two elements at least.
        while let Some((i, placed)) = taken.next(&mentioned) {
            let relation = taken.left.remove(i);
            for e in relation.elements() {
                mentioned[e] -= 1;
            }
            match placed {
                Some(element) => taken.last.push((element, relation)),
                None => taken.sizes.push(relation),
            }
        }
        // What is taken first is placed last.
        taken.last.reverse();
        taken
    }

    /// A relation that can be taken off, and the element that it places.
    fn next(&self, mentioned: &[usize]) -> Option<(usize, Option<usize>)> {
        let once = |value: usize| {
            let all = self.left.iter().flat_map(|r| r.values());
            all.filter(|(v, _)| *v == value).count() == 1
        };
        let few = mentioned.len() - self.last.len() <= 2;
        let relations = self.left.iter().enumerate();
        let mut taken = relations.filter_map(|(i, relation)| {
            let places = match relation {
                Relation::Middle { point, of } => vec![*point, of[1], of[0]],
                Relation::Mirrored { pair, .. } => vec![pair[1], pair[0]],
                Relation::Measured { terms, .. } => {
                    return terms.iter().any(|(v, _)| once(*v)).then_some((i, None));
                }
            };
            let free = places.into_iter().find(|&e| mentioned[e] == 1);
            free.filter(|_| !few).map(|e| (i, Some(e)))
        });
        taken.next()
    }
}
