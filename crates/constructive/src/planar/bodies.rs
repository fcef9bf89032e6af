//! Which links are one body, and which joints one element.

use super::NotPlanar;
use super::body::Exact;
use super::places::View;
use kutzbach_model::mechanism::{ExactPose, JointKind, Mechanism, Placement};

/// Elements by body.
pub(super) struct Bodies {
    /// A first joint of every element.
    pub(super) names: Vec<String>,
    /// Where that is drawn.
    pub(super) elements: Vec<Exact>,
    /// Name of a first link, and the elements where the body has them.
    pub(super) of_body: Vec<(String, Vec<(usize, Exact)>)>,
    /// The body of every link, as an index of these.
    pub(super) of_link: Vec<usize>,
}

/// Where every link is drawn at home.
pub(super) fn homes(mechanism: &Mechanism) -> Vec<ExactPose> {
    let mut homes = vec![ExactPose::identity(); mechanism.links().len()];
    for &link in mechanism.placement_order() {
        homes[link.0] = match &mechanism.link(link).placement {
            Placement::World => ExactPose::identity(),
            Placement::Joint(joint) => {
                let joint = mechanism.joint(*joint);
                let parent = &homes[joint.predecessor.link.0];
                let back = ExactPose::of(&joint.successor.frame).inverse();
                parent
                    .then(&ExactPose::of(&joint.predecessor.frame))
                    .then(&back)
            }
            Placement::Floating { parent, origin, .. } => {
                homes[parent.0].then(&ExactPose::of(origin))
            }
        };
    }
    homes
}

/// A hinge or slider between two bodies, where each of them has it.
struct Pin<'a> {
    name: &'a str,
    on: [usize; 2],
    places: [Exact; 2],
}

impl Bodies {
    pub(super) fn of(
        mechanism: &Mechanism,
        homes: &[ExactPose],
        view: &View,
    ) -> Result<Self, NotPlanar> {
        let body = welded(mechanism, homes)?;
        let mut pins = Vec::new();
        for joint in mechanism.joints() {
            if joint.kind == JointKind::Fixed {
                continue;
            }
            let sides = [&joint.predecessor, &joint.successor];
            let [one, other] = sides.map(|side| view.element(joint, side, homes));
            let places = [one?, other?];
            view.check_normal(joint, homes)?;
            let on = sides.map(|s| body[s.link.0]);
            if on[0] != on[1] {
                let name = &joint.name;
                pins.push(Pin { name, on, places });
            } else if !places[0].same(&places[1]) {
                return Err(NotPlanar::Within {
                    joint: joint.name.clone(),
                    link: mechanism.links()[on[0]].name.clone(),
                    gap: places[0].gap(&places[1]),
                });
            }
        }
        let names = mechanism.links().iter().map(|l| l.name.clone());
        Self::shared(&pins, names.collect(), body)
    }

    /// Pins that are in one place on some body are one element, and so on from body to body.
    fn shared(
        pins: &[Pin<'_>],
        links: Vec<String>,
        of_link: Vec<usize>,
    ) -> Result<Self, NotPlanar> {
        let mut on_body: Vec<Vec<(usize, usize)>> = vec![Vec::new(); links.len()];
        for (pin, k) in (0..pins.len()).flat_map(|pin| [(pin, 0), (pin, 1)]) {
            on_body[pins[pin].on[k]].push((pin, k));
        }
        let place = |(pin, k): (usize, usize)| &pins[pin].places[k];
        let mut class: Vec<usize> = (0..pins.len()).collect();
        for on in &on_body {
            for (i, &one) in on.iter().enumerate() {
                let same = on[..i].iter().find(|other| place(**other).same(place(one)));
                if let Some(&(other, _)) = same {
                    let [a, b] = [class[one.0], class[other]];
                    let joined =
                        |c: &mut usize| *c = if *c == a || *c == b { a.min(b) } else { *c };
                    class.iter_mut().for_each(joined);
                }
            }
        }
        let mut firsts = class.clone();
        firsts.sort_unstable();
        firsts.dedup();
        let mut of_body: Vec<(String, Vec<(usize, Exact)>)> = Vec::new();
        for (link, on) in links.into_iter().zip(&on_body) {
            let mut held: Vec<(usize, Exact)> = Vec::new();
            for &at in on {
                let element = firsts.partition_point(|&f| f < class[at.0]);
                match held.iter().find(|h| h.0 == element) {
                    None => held.push((element, place(at).clone())),
                    Some((_, known)) if known.same(place(at)) => {}
                    Some(_) => {
                        return Err(NotPlanar::Apart {
                            link,
                            joints: [firsts[element], at.0].map(|p| pins[p].name.to_owned()),
                        });
                    }
                }
            }
            of_body.push((link, held));
        }
        Ok(Self {
            names: firsts.iter().map(|&p| pins[p].name.to_owned()).collect(),
            elements: firsts.iter().map(|&p| pins[p].places[0].clone()).collect(),
            of_body,
            of_link,
        })
    }

    /// What each body has.
    pub(super) fn held(&self) -> impl Iterator<Item = (&str, &[(usize, Exact)])> {
        self.of_body.iter().map(|(name, held)| (&**name, &**held))
    }
}

/// A link that stands for the body of every link.
fn welded(mechanism: &Mechanism, homes: &[ExactPose]) -> Result<Vec<usize>, NotPlanar> {
    let mut body: Vec<usize> = (0..homes.len()).collect();
    for joint in mechanism.joints() {
        if joint.kind != JointKind::Fixed {
            continue;
        }
        let sides = [&joint.predecessor, &joint.successor];
        let [one, other] = sides.map(|s| homes[s.link.0].then(&ExactPose::of(&s.frame)));
        if joint.closes_loop && one != other {
            let joint = joint.name.clone();
            return Err(NotPlanar::Fixed { joint });
        }
        let [a, b] = sides.map(|s| body[s.link.0]);
        let kept = a.min(b);
        for of in &mut body {
            if *of == a || *of == b {
                *of = kept;
            }
        }
    }
    Ok(body)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_math::number::Number;

    fn point(x: i64) -> Exact {
        Exact::Point([Number::integer(x), Number::zero()])
    }

    fn pin(name: &str, on: [usize; 2], places: [i64; 2]) -> Pin<'_> {
        Pin {
            name,
            on,
            places: places.map(point),
        }
    }

    fn links(count: usize) -> Vec<String> {
        (0..count).map(|k| format!("link {k}")).collect()
    }

    #[test]
    fn pins_in_one_place_are_one_element_whatever_their_order() {
        // Four links at one pin: the last joint finds it on both of its links.
        let pins = [
            pin("a", [0, 1], [0, 0]),
            pin("b", [2, 3], [0, 0]),
            pin("c", [1, 2], [0, 0]),
            pin("d", [0, 3], [5, 7]),
        ];
        let bodies = Bodies::shared(&pins, links(4), (0..4).collect()).unwrap();
        assert_eq!(bodies.names, ["a", "d"]);
        let held: Vec<Vec<usize>> = bodies
            .held()
            .map(|(_, held)| held.iter().map(|h| h.0).collect())
            .collect();
        assert_eq!(held, [vec![0, 1], vec![0], vec![0], vec![0, 1]]);
    }

    #[test]
    fn one_element_in_two_places_of_a_body_is_told() {
        let pins = [
            pin("a", [0, 1], [0, 0]),
            pin("b", [1, 2], [0, 0]),
            pin("c", [2, 0], [0, 3]),
        ];
        let error = Bodies::shared(&pins, links(3), (0..3).collect())
            .err()
            .unwrap();
        let told = "link `link 0` has `a` and `c` in two places, other links in one";
        assert_eq!(error.to_string(), told);
    }
}
