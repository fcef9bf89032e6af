//! Equalities: what closes loops, and what couples joints.

use super::Mjcf;
use super::closures::Connects;
use super::pose::{exactly, numbers};
use crate::WarningKind;
use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::frames::added;
use crate::words::{did_you_mean, quoted};
use kutzbach_math::number::{Inputs, Number, NumberError, Quantity};

impl<'a> Mjcf<'a> {
    /// Whether an equality counts from the start.
    pub(super) fn is_active(&self, element: Element<'a>) -> Outcome<bool> {
        if self.switched_off.equalities() {
            return Ok(false);
        }
        let class = self.classes.of(element, None)?;
        let own = element.attribute("active");
        let says = own.or_else(|| self.classes.says(class, "equality", "active"));
        Ok(says.is_none_or(|word| word.value != "false"))
    }

    /// Joints that are held at the pose drawn.
    pub(super) fn note_held(&mut self, equality: Element<'a>) -> Outcome<()> {
        for part in equality.elements().filter(|part| part.name() == "joint") {
            let alone = part.attribute("joint2").is_none();
            let Some(joint) = part.attribute("joint1").filter(|_| alone) else {
                continue;
            };
            let [held_at, ..] = polynomial(part)?;
            // Held elsewhere it is coupled to nothing else: see `joint_equality`.
            if self.is_active(part)? && held_at.is_zero() {
                self.held.insert(joint.value);
            }
        }
        Ok(())
    }

    /// Everything in `<equality>`.
    pub(super) fn equalities(&mut self, equality: Element<'a>, root: Element<'a>) -> Outcome<()> {
        let mut connects = Connects::default();
        for part in equality.elements() {
            if !self.is_active(part)? {
                self.unread.text(
                    part.start(),
                    format!("<{}> that is not active", part.name()),
                );
                continue;
            }
            match part.name() {
                "connect" | "weld" if self.is_to_mocap(part) => {
                    let what = format!("<{}> to a body that a user moves (mocap)", part.name());
                    self.unread.text(part.start(), what);
                }
                "connect" => self.connect(part, &mut connects)?,
                "weld" => self.weld(part)?,
                "joint" => self.joint_equality(part)?,
                "tendon" => self.tendon_equality(part, root)?,
                name => {
                    let message = format!("<{name}> in <equality> is not read, and it constrains");
                    self.warnings
                        .push((part.start(), WarningKind::MayJoin, message));
                }
            }
        }
        self.close_all(connects)
    }

    /// A joint of one freedom that an equality names.
    fn coupled(&self, attribute: Attribute<'a>) -> Outcome<&'a str> {
        match self.joints.get(attribute.value) {
            Some(known) if known.kind.freedom() == 1 => Ok(attribute.value),
            Some(known) => Err(attribute.fault(format!(
                "joint {} is a <{}> of more than one degree of freedom and cannot be coupled",
                quoted(attribute.value),
                known.element.name()
            ))),
            None => {
                let known = self.joints.keys().copied();
                Err(attribute
                    .fault(format!("there is no joint {}", quoted(attribute.value)))
                    .maybe_help(did_you_mean(attribute.value, known, ("`", "`"))))
            }
        }
    }

    fn joint_equality(&mut self, part: Element<'a>) -> Outcome<()> {
        let follower = self.coupled(part.required("joint1")?)?;
        let [offset, terms @ ..] = polynomial(part)?;
        let mut sum = vec![(follower, 1, Number::one())];
        let Some(leader) = part.attribute("joint2") else {
            let held = self.held.contains(follower);
            return match held {
                true => Ok(()),
                false => self.couple(part, sum, offset),
            };
        };
        let leader = self.coupled(leader)?;
        let powers = (1..).zip(&terms);
        sum.extend(powers.map(|(power, factor)| (leader, power, -factor)));
        self.couple(part, sum, offset)
    }

    /// Couples joints by a sum: two of them by a mimic, as long as no joint follows two others or, by way of others, itself.
    fn couple(
        &mut self,
        part: Element<'a>,
        mut sum: Vec<(&'a str, u32, Number)>,
        offset: Number,
    ) -> Outcome<()> {
        // What is held has no value but 0.
        sum.retain(|(name, _, factor)| !factor.is_zero() && !self.held.contains(name));
        if sum.is_empty() {
            let message = format!("<{}> between joints that stand still anyway", part.name());
            self.unread.text(part.start(), message);
            return Ok(());
        }
        if let [(follower, 1, a), (leader, 1, b)] = &sum[..]
            && self.may_follow(follower, leader)
        {
            let over = |x: &Number| quotient(x, a).map_err(|why| part.fault(why.to_string()));
            let (multiplier, offset) = (over(&-b)?, over(&offset)?);
            self.followers.insert(follower, leader);
            self.builder.mimic(follower, leader, multiplier, offset);
            return Ok(());
        }
        let name = self.name_of_closure(part, "coupling");
        let terms = sum
            .into_iter()
            .map(|(joint, power, factor)| (joint.to_owned(), power, factor));
        self.builder
            .polynomial_coupling(&name, terms.collect(), offset);
        Ok(())
    }

    fn may_follow(&self, follower: &str, leader: &str) -> bool {
        let mut at = Some(leader);
        while let Some(joint) = at {
            if joint == follower {
                return false;
            }
            at = self.followers.get(joint).copied();
        }
        !self.followers.contains_key(follower)
    }

    /// An equality of fixed tendons, each a sum of joints with coefficients.
    fn tendon_equality(&mut self, part: Element<'a>, root: Element<'a>) -> Outcome<()> {
        let [offset, terms @ ..] = polynomial(part)?;
        let Some(first) = self.shares_of(part, root, "tendon1")? else {
            return Ok(());
        };
        let own = first.into_iter().map(|(joint, share)| (joint, 1, share));
        let mut sum: Vec<(&'a str, u32, Number)> = own.collect();
        if part.attribute("tendon2").is_some() {
            let Some(second) = self.shares_of(part, root, "tendon2")? else {
                return Ok(());
            };
            let bent = terms.iter().skip(1).any(|term| !term.is_zero());
            if bent && second.len() > 1 {
                let message =
                    "a power of a tendon over several joints is not read, and it constrains";
                self.may_join(part, message);
                return Ok(());
            }
            for (joint, share) in &second {
                let mut power_of_share = Number::one();
                for (power, factor) in (1..).zip(&terms) {
                    power_of_share = product(&power_of_share, share);
                    let own = -&product(factor, &power_of_share);
                    let same =
                        |(name, of, _): &&mut (&'a str, u32, Number)| name == joint && *of == power;
                    match sum.iter_mut().find(same) {
                        Some((_, _, all)) => *all = added(FACTOR, all, &own),
                        None => sum.push((*joint, power, own)),
                    }
                }
            }
        }
        self.couple(part, sum, offset)
    }

    /// The joints of a fixed tendon with their coefficients; `None`, and told, where the tendon is another.
    fn shares_of(
        &mut self,
        part: Element<'a>,
        root: Element<'a>,
        side: &'static str,
    ) -> Outcome<Option<Vec<(&'a str, Number)>>> {
        let name = part.required(side)?;
        let Some(tendon) = tendon_named(root, name.value) else {
            return Err(name.fault(format!("there is no tendon {}", quoted(name.value))));
        };
        if tendon.name() != "fixed" {
            let message = "an equality of a tendon through space is not read, and it constrains";
            self.may_join(part, message);
            return Ok(None);
        }
        let mut shares: Vec<(&'a str, Number)> = Vec::new();
        for joint in tendon.elements().filter(|joint| joint.name() == "joint") {
            let name = self.coupled(joint.required("joint")?)?;
            let [coefficient] = exactly(joint.required("coef")?)?;
            match shares.iter_mut().find(|(own, _)| *own == name) {
                Some((_, all)) => *all = added(FACTOR, all, &coefficient),
                None => shares.push((name, coefficient)),
            }
        }
        Ok(Some(shares))
    }

    fn may_join(&mut self, part: Element<'a>, message: &str) {
        let warning = (part.start(), WarningKind::MayJoin, message.to_owned());
        self.warnings.push(warning);
    }
}

/// What factors of couplings count as: they are in no group of the geometry.
const FACTOR: Quantity = Quantity::Length;

/// A product that knows the literals of both factors; one with 1 keeps the digits of the other.
fn product(a: &Number, b: &Number) -> Number {
    let one = Number::one();
    if *a == one {
        return b.clone();
    }
    if *b == one {
        return a.clone();
    }
    let mut inputs = Inputs::default();
    inputs.add(FACTOR, a, b.value());
    inputs.add(FACTOR, b, a.value());
    (a * b).derived_from(inputs)
}

/// A quotient that knows the literals of both; one by 1 keeps its digits.
fn quotient(a: &Number, b: &Number) -> Result<Number, NumberError> {
    if *b == Number::one() {
        return Ok(a.clone());
    }
    let found = a.checked_div(b)?;
    let mut inputs = Inputs::default();
    inputs.add(FACTOR, a, 1.0 / b.value());
    inputs.add(FACTOR, b, found.value() / b.value());
    Ok(found.derived_from(inputs))
}

/// The five coefficients of `polycoef`; those left out are 0 1 0 0 0, each in its place.
fn polynomial(part: Element<'_>) -> Outcome<[Number; 5]> {
    let mut found = [(); 5].map(|()| Number::zero());
    found[1] = Number::one();
    let Some(says) = part.attribute("polycoef") else {
        return Ok(found);
    };
    let given = numbers(says)?;
    if given.len() > found.len() {
        let message = format!("expected 5 numbers at most, found {}", given.len());
        return Err(says.fault(message));
    }
    for (own, given) in found.iter_mut().zip(given) {
        *own = given;
    }
    Ok(found)
}

fn tendon_named<'a>(root: Element<'a>, name: &str) -> Option<Element<'a>> {
    let tendons = root.elements().filter(|part| part.name() == "tendon");
    let mut all = tendons.flat_map(|part| part.elements());
    all.find(|tendon| {
        tendon
            .attribute("name")
            .is_some_and(|own| own.value == name)
    })
}
