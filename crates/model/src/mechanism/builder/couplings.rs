//! Couplings: from names to equations between joint variables.

use super::checks::{check_finite, check_one_freedom};
use super::names::Names;
use super::ratio::LinkTree;
use crate::mechanism::{
    Coupling, CouplingOrigin, CouplingTerm, Entity, HIGHEST_POWER, Joint, JointId, Link, LinkId,
    MechanismError,
};
use kutzbach_math::number::Number;
use std::collections::{BTreeMap, BTreeSet};

/// A coupling as its maker describes it.
#[derive(Clone, Debug)]
pub(super) struct CouplingSpec {
    pub(super) name: String,
    pub(super) relation: Relation,
}

/// What a coupling relates.
#[derive(Clone, Debug)]
pub(super) enum Relation {
    /// Rates of two links.
    Ratio {
        predecessor: String,
        successor: String,
        ratio: Number,
        carrier: Option<String>,
    },
    /// Variables of two joints.
    Mimic {
        follower: String,
        leader: String,
        multiplier: Number,
        offset: Number,
    },
    /// A sum over powers of the variables of joints.
    Sum {
        terms: Vec<(String, u32, Number)>,
        offset: Number,
    },
}

/// Resolves all couplings, in their order. `order` is the placement order of the links.
pub(super) fn resolve_couplings(
    specs: Vec<CouplingSpec>,
    links: &[Link],
    joints: &[Joint],
    order: &[LinkId],
    names: &mut Names,
) -> Result<Vec<Coupling>, MechanismError> {
    let tree = LinkTree::new(links, joints, order);
    let mut couplings = Vec::with_capacity(specs.len());
    for CouplingSpec { name, relation } in specs {
        let entity = match &relation {
            Relation::Ratio { .. } | Relation::Sum { .. } => Entity::Coupling(name.clone()),
            Relation::Mimic { follower, .. } => Entity::Joint(follower.clone()),
        };
        names.add_coupling(&name, &entity)?;
        couplings.push(match relation {
            Relation::Ratio {
                predecessor,
                successor,
                ratio,
                carrier,
            } => {
                check_finite(&entity, "ratio", &ratio)?;
                let predecessor = names.link(&entity, &predecessor)?;
                let successor = names.link(&entity, &successor)?;
                let carrier = carrier
                    .map(|carrier| names.link(&entity, &carrier))
                    .transpose()?;
                let ends = [predecessor, successor];
                let (terms, assumed) = tree.ratio_terms(&entity, ends, carrier, &ratio)?;
                Coupling {
                    name,
                    terms,
                    offset: Number::zero(),
                    origin: CouplingOrigin::Ratio {
                        predecessor,
                        successor,
                        ratio,
                        carrier,
                        assumed,
                    },
                }
            }
            Relation::Mimic {
                follower,
                leader,
                multiplier,
                offset,
            } => {
                check_finite(&entity, "multiplier", &multiplier)?;
                check_finite(&entity, "offset", &offset)?;
                let follower = mimic_joint(&entity, &follower, joints, names)?;
                let leader = mimic_joint(&entity, &leader, joints, names)?;
                if follower == leader {
                    return Err(MechanismError::new(entity, "the joint mimics itself"));
                }
                Coupling {
                    name,
                    terms: mimic_terms(follower, leader, &multiplier),
                    offset: offset.clone(),
                    origin: CouplingOrigin::Mimic {
                        follower,
                        leader,
                        multiplier,
                        offset,
                    },
                }
            }
            Relation::Sum { terms, offset } => {
                check_finite(&entity, "offset", &offset)?;
                Coupling {
                    name,
                    terms: terms_of_sum(&entity, terms, joints, names)?,
                    offset,
                    origin: CouplingOrigin::Sum,
                }
            }
        });
    }
    check_mimic_circles(&couplings, joints)?;
    Ok(couplings)
}

/// The terms of a sum, each joint once, in the order in which they are first named; what has no coefficient but zero has no part in it.
fn terms_of_sum(
    entity: &Entity,
    terms: Vec<(String, u32, Number)>,
    joints: &[Joint],
    names: &Names,
) -> Result<Vec<CouplingTerm>, MechanismError> {
    let fault = |message: String| MechanismError::new(entity.clone(), message);
    let mut all: Vec<(JointId, BTreeMap<u32, Number>)> = Vec::with_capacity(terms.len());
    for (name, power, factor) in terms {
        check_finite(entity, "coefficient", &factor)?;
        let joint = names.joint(entity, &name, || {
            format!("a term names joint `{name}`, which does not exist")
        })?;
        check_one_freedom(entity, &joints[joint.0])?;
        if !(1..=HIGHEST_POWER).contains(&power) {
            let message =
                format!("the power of a term is {power}, and 1 to {HIGHEST_POWER} are read");
            return Err(fault(message));
        }
        let place = all.iter().position(|(own, _)| *own == joint);
        let place = place.unwrap_or_else(|| {
            all.push((joint, BTreeMap::new()));
            all.len() - 1
        });
        if all[place].1.insert(power, factor).is_some() {
            let of_power = match power {
                1 => String::new(),
                power => format!(" of power {power}"),
            };
            return Err(fault(format!("joint `{name}` has two terms{of_power}")));
        }
    }
    let terms = all.into_iter().map(|(joint, mut powers)| {
        powers.retain(|_, factor| !factor.is_zero());
        let highest = powers.keys().next_back().copied().unwrap_or(0);
        let mut factor = |power: u32| powers.remove(&power).unwrap_or_else(Number::zero);
        CouplingTerm {
            joint,
            factor: factor(1),
            higher: (2..=highest).map(factor).collect(),
        }
    });
    let terms: Vec<CouplingTerm> = terms
        .filter(|term| !term.factor.is_zero() || !term.higher.is_empty())
        .collect();
    if terms.is_empty() {
        let none = "a coupling needs a joint with a coefficient that is not zero";
        return Err(fault(none.to_owned()));
    }
    Ok(terms)
}

fn mimic_joint(
    entity: &Entity,
    name: &str,
    joints: &[Joint],
    names: &Names,
) -> Result<JointId, MechanismError> {
    let id = names.joint(entity, name, || {
        format!("mimic names joint `{name}`, which does not exist")
    })?;
    check_one_freedom(entity, &joints[id.0]).map(|()| id)
}

/// A joint that follows itself through others would be told twice what it does.
fn check_mimic_circles(couplings: &[Coupling], joints: &[Joint]) -> Result<(), MechanismError> {
    let leaders: BTreeMap<JointId, JointId> = couplings
        .iter()
        .filter_map(|coupling| match coupling.origin {
            CouplingOrigin::Mimic {
                follower, leader, ..
            } => Some((follower, leader)),
            CouplingOrigin::Ratio { .. } | CouplingOrigin::Sum => None,
        })
        .collect();
    let mut settled: BTreeSet<JointId> = BTreeSet::new();
    for &start in leaders.keys() {
        let mut walk = Vec::new();
        let mut joint = start;
        while let Some(&leader) = leaders.get(&joint) {
            if !settled.insert(joint) {
                break;
            }
            walk.push(joint);
            joint = leader;
        }
        // A walk that ends on itself has found a circle; the joints before it only lead there.
        if let Some(first) = walk.iter().position(|visited| *visited == joint) {
            let names: Vec<&str> = walk[first..]
                .iter()
                .map(|id| joints[id.0].name.as_str())
                .collect();
            return Err(MechanismError::new(
                Entity::Joint(joints[joint.0].name.clone()),
                format!("mimic runs in a circle: {}", names.join(" -> ")),
            ));
        }
    }
    Ok(())
}

/// `follower − multiplier × leader`.
fn mimic_terms(follower: JointId, leader: JointId, multiplier: &Number) -> Vec<CouplingTerm> {
    let mut terms = vec![CouplingTerm::linear(follower, Number::one())];
    if !multiplier.is_zero() {
        terms.push(CouplingTerm::linear(leader, -multiplier));
    }
    terms
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::MechanismBuilder;
    use super::super::samples::{chain, fault, help, hinge, hinges, links, number, terms};
    use super::*;
    use crate::mechanism::JointKind;

    #[test]
    fn a_mimic_is_one_equation_named_after_its_follower() {
        let mut builder = hinges();
        builder.mimic("bc", "ab", number("-2"), number("0.25"));
        let mechanism = builder.build().unwrap();
        assert_eq!(mechanism.couplings()[0].name, "bc.mimic");
        assert_eq!(mechanism.couplings()[0].offset, number("0.25"));
        assert_eq!(terms(&mechanism), [("bc", 1.0), ("ab", 2.0)]);

        let mut builder = hinges();
        builder.mimic("bc", "ab", number("0"), number("0.25"));
        assert_eq!(terms(&builder.build().unwrap()), [("bc", 1.0)]);
    }

    #[test]
    fn what_cannot_be_mimicked() {
        let mimic = |mut builder: MechanismBuilder, follower: &str, leader: &str| {
            builder.mimic(follower, leader, Number::one(), Number::zero());
            builder
        };
        let ball = || chain(JointKind::Revolute, JointKind::Spherical);
        let told = "joint `bc` is spherical with 3 degrees of freedom; only a joint with one has a single rate";
        assert_eq!(
            fault(mimic(ball(), "ab", "bc")),
            format!("joint `ab`: {told}")
        );
        assert_eq!(
            fault(mimic(ball(), "bc", "ab")),
            format!("joint `bc`: {told}")
        );
        let fixed = chain(JointKind::Revolute, JointKind::Fixed);
        assert!(fault(mimic(fixed, "ab", "bc")).contains("fixed with 0 degrees of freedom"));
        assert_eq!(
            fault(mimic(hinges(), "ab", "cb")),
            "joint `ab`: mimic names joint `cb`, which does not exist"
        );
        assert_eq!(
            help(mimic(hinges(), "ab", "cb")),
            "did you mean `ab`?",
            "one letter off `ab`, two off `bc`"
        );
        assert_eq!(
            fault(mimic(hinges(), "ab", "ab")),
            "joint `ab`: the joint mimics itself"
        );
        for (multiplier, offset, what) in [("1e101", "0", "multiplier"), ("1", "1e101", "offset")] {
            let mut builder = hinges();
            builder.mimic("ab", "bc", number(multiplier), number(offset));
            assert!(fault(builder).contains(&format!("{what} is 1e101")));
        }
    }

    /// Hinges `j0`, `j1`, ... from one ground, each following another by index.
    fn followers(leaders: &[usize]) -> MechanismBuilder {
        let mut builder = links(&["ground"]);
        for (index, leader) in leaders.iter().enumerate() {
            let (joint, link) = (format!("j{index}"), format!("l{index}"));
            builder.link(&link);
            builder.joint(hinge(&joint, "ground", &link));
            if *leader != index {
                builder.mimic(&joint, &format!("j{leader}"), Number::one(), Number::zero());
            }
        }
        builder
    }

    #[test]
    fn mimics_may_form_trees_but_no_circle() {
        // j3 -> j2 -> j0 <- j1: whoever leads in the end is free.
        assert!(followers(&[0, 0, 0, 2]).build().is_ok());
        assert_eq!(
            fault(followers(&[1, 0])),
            "joint `j0`: mimic runs in a circle: j0 -> j1"
        );
        assert_eq!(
            fault(followers(&[0, 2, 3, 1, 0])),
            "joint `j1`: mimic runs in a circle: j1 -> j2 -> j3"
        );
        // j0 and j1 lead into the circle but are not on it.
        assert_eq!(
            fault(followers(&[1, 2, 3, 2])),
            "joint `j2`: mimic runs in a circle: j2 -> j3"
        );
    }
}
