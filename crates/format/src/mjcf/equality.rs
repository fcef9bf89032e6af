//! Equalities: what closes loops, and what couples joints.

use super::anchors::{Held, meaning};
use super::pose::{exactly, numbers};
use super::{Mjcf, WORLD};
use crate::WarningKind;
use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::quaternion::roll_pitch_yaw;
use crate::words::{did_you_mean, quoted};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind};

/// A `<connect>` by bodies: its element, the bodies, and the point in the first one.
struct Connect<'a> {
    element: Element<'a>,
    bodies: [&'a str; 2],
    anchor: [Number; 3],
}

impl<'a> Mjcf<'a> {
    /// Whether an equality counts from the start.
    pub(super) fn is_active(&self, element: Element<'a>) -> Outcome<bool> {
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
            let held_at = match part.attribute("polycoef") {
                Some(terms) => numbers(terms)?.into_iter().next(),
                None => None,
            };
            if !self.is_active(part)? {
                continue;
            }
            // Held elsewhere it is coupled to nothing else: see `joint_equality`.
            if held_at.is_some_and(|at| !at.is_zero()) {
                continue;
            }
            self.held.insert(joint.value);
        }
        Ok(())
    }

    /// Everything in `<equality>`.
    pub(super) fn equalities(&mut self, equality: Element<'a>, root: Element<'a>) -> Outcome<()> {
        let mut connects: Vec<Vec<Connect<'a>>> = Vec::new();
        for part in equality.elements() {
            if !self.is_active(part)? {
                self.unread.text(
                    part.start(),
                    format!("<{}> that is not active", part.name()),
                );
                continue;
            }
            let to_mocap = ["body1", "body2"].iter().any(|side| {
                part.attribute(side)
                    .is_some_and(|body| self.mocap.contains(body.value))
            });
            match part.name() {
                "connect" | "weld" if to_mocap => {
                    let what = format!("<{}> to a body that a user moves (mocap)", part.name());
                    self.unread.text(part.start(), what);
                }
                "connect" if part.attribute("body1").is_some() => {
                    let connect = self.connect(part)?;
                    let same = |group: &&mut Vec<Connect<'a>>| group[0].bodies == connect.bodies;
                    match connects.iter_mut().find(same) {
                        Some(group) => group.push(connect),
                        None => connects.push(vec![connect]),
                    }
                }
                "connect" => self.between_sites(part, JointKind::Spherical)?,
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
        connects
            .into_iter()
            .try_for_each(|group| self.close(&group))
    }

    fn connect(&self, part: Element<'a>) -> Outcome<Connect<'a>> {
        let one = self.body(part.required("body1")?)?;
        let other = match part.attribute("body2") {
            Some(body) => self.body(body)?,
            None => WORLD,
        };
        Ok(Connect {
            element: part,
            bodies: [one, other],
            anchor: exactly(part.required("anchor")?)?,
        })
    }

    fn name_of_closure(&mut self, part: Element<'a>, made: &str) -> String {
        let own = part.attribute("name").map_or(made, |own| own.value);
        let name = self.name_for(&self.names, own);
        self.names.insert(name.clone(), part.range());
        name
    }

    /// Closes a loop by points of two bodies: one is a ball, two are the hinge on their line, three or more hold the bodies together.
    fn close(&mut self, group: &[Connect<'a>]) -> Outcome<()> {
        let Some(first) = group.first() else {
            return Ok(());
        };
        let [one, other] = first.bodies;
        let at = |anchor: &[Number; 3]| Frame {
            position: anchor.clone(),
            ..Frame::identity()
        };
        let anchors: Vec<[Number; 3]> = group.iter().map(|c| c.anchor.clone()).collect();
        let meaning = meaning(&anchors);
        let name = self.name_of_closure(first.element, &format!("{one}_{other}"));
        let (kind, axis, what) = match meaning.held {
            Held::Point => (JointKind::Spherical, None, "one, a ball"),
            Held::Line(way) => {
                let what = "the hinge on the line of their anchors";
                (JointKind::Revolute, Some(way), what)
            }
            Held::All => (JointKind::Fixed, None, "a fixed joint"),
        };
        let mut joint =
            JointBuilder::closing(&name, kind, one, other).at_home(one, at(&first.anchor), false);
        joint = axis.into_iter().fold(joint, JointBuilder::axis);
        self.builder.joint(joint);
        if group.len() == 1 {
            return Ok(());
        }
        let within = match (meaning.is_unclear, meaning.within_digits) {
            (true, _) => ", though their anchors differ by few units of their last digits",
            (_, true) => ": within the digits of their anchors they are that",
            _ => "",
        };
        let message = format!(
            "{} <connect> between {} and {} are read as {what}{within}",
            group.len(),
            quoted(one),
            quoted(other)
        );
        let kind = match meaning.is_unclear {
            true => WarningKind::Guessed,
            false => WarningKind::ReadAs {
                joint: name,
                element: "connect".to_owned(),
            },
        };
        self.warnings.push((first.element.start(), kind, message));
        Ok(())
    }

    /// A closure between two sites, which need not meet at the pose drawn.
    fn between_sites(&mut self, part: Element<'a>, kind: JointKind) -> Outcome<()> {
        let mut sides = Vec::new();
        for side in ["site1", "site2"] {
            let site = part.required(side)?;
            let Some(place) = self.sites.get(site.value).cloned() else {
                let known = self.sites.keys().copied();
                return Err(site
                    .fault(format!("there is no site {}", quoted(site.value)))
                    .maybe_help(did_you_mean(site.value, known, ("`", "`"))));
            };
            let mut place = place;
            if kind == JointKind::Spherical
                && let Some(last) = place.chain.last_mut()
            {
                // A ball has no directions: how the site is turned says nothing.
                last.roll_pitch_yaw = Frame::identity().roll_pitch_yaw;
            }
            sides.push((self.at(&place, site.value), site.value));
        }
        let [((one, from), a), ((other, to), b)] = &sides[..] else {
            return Ok(());
        };
        let name = self.name_of_closure(part, &format!("{a}_{b}"));
        let joint = JointBuilder::closing(&name, kind, one, other)
            .origin(from.clone())
            .successor_origin(to.clone());
        self.builder.joint(joint);
        Ok(())
    }

    fn weld(&mut self, part: Element<'a>) -> Outcome<()> {
        let class = self.classes.of(part, None)?;
        let scale = part
            .attribute("torquescale")
            .or_else(|| self.classes.says(class, "equality", "torquescale"));
        let point = match scale {
            Some(scale) => numbers(scale)?.iter().all(Number::is_zero),
            None => false,
        };
        let kind = match point {
            true => JointKind::Spherical,
            false => JointKind::Fixed,
        };
        if part.attribute("site1").is_some() {
            return self.between_sites(part, kind);
        }
        let one = self.body(part.required("body1")?)?;
        let other = match part.attribute("body2") {
            Some(body) => self.body(body)?,
            None => WORLD,
        };
        let name = self.name_of_closure(part, &format!("{one}_{other}"));
        let mut anchor = Frame::identity();
        if let Some(position) = part.attribute("anchor") {
            anchor.position = exactly(position)?;
        }
        let relative = match part.attribute("relpose") {
            Some(pose) => relative_pose(pose)?,
            None => None,
        };
        let joint = JointBuilder::closing(&name, kind, one, other);
        let joint = match relative {
            // The pose of the second body in the first one; a point of the second one, where only that is held, follows from it.
            Some(pose) if !point || anchor.is_identity() => joint.origin(pose),
            Some(_) => {
                return Err(part
                    .fault("<weld> with `relpose`, `anchor` and a torquescale of 0 is not read")
                    .help("use <connect> with two sites"));
            }
            None => joint.at_home(other, anchor, false),
        };
        self.builder.joint(joint);
        Ok(())
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
        let terms = match part.attribute("polycoef") {
            Some(terms) => numbers(terms)?,
            None => vec![Number::zero(), Number::one()],
        };
        let mut sum = vec![(follower, 1, Number::one())];
        let Some(leader) = part.attribute("joint2") else {
            let held = self.held.contains(follower);
            return match held {
                true => Ok(()),
                false => self.couple(part, sum, first_of(&terms)),
            };
        };
        let leader = self.coupled(leader)?;
        let powers = (1..).zip(terms.iter().skip(1));
        sum.extend(powers.map(|(power, factor)| (leader, power, -factor)));
        self.couple(part, sum, first_of(&terms))
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
            let over = |x: &Number| x.checked_div(a).map_err(|why| part.fault(why.to_string()));
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
        let terms = match part.attribute("polycoef") {
            Some(terms) => numbers(terms)?,
            None => vec![Number::zero(), Number::one()],
        };
        let Some(first) = self.shares_of(part, root, "tendon1")? else {
            return Ok(());
        };
        let own = first.into_iter().map(|(joint, share)| (joint, 1, share));
        let mut sum: Vec<(&'a str, u32, Number)> = own.collect();
        if part.attribute("tendon2").is_some() {
            let Some(second) = self.shares_of(part, root, "tendon2")? else {
                return Ok(());
            };
            let bent = terms.iter().skip(2).any(|term| !term.is_zero());
            if bent && second.len() > 1 {
                let message =
                    "a power of a tendon over several joints is not read, and it constrains";
                self.may_join(part, message);
                return Ok(());
            }
            for (joint, share) in &second {
                let mut power_of_share = Number::one();
                for (power, factor) in (1..).zip(terms.iter().skip(1)) {
                    power_of_share = &power_of_share * share;
                    let own = -&(factor * &power_of_share);
                    let same =
                        |(name, of, _): &&mut (&'a str, u32, Number)| name == joint && *of == power;
                    match sum.iter_mut().find(same) {
                        Some((_, _, all)) => *all = &*all + &own,
                        None => sum.push((*joint, power, own)),
                    }
                }
            }
        }
        self.couple(part, sum, first_of(&terms))
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
                Some((_, all)) => *all = &*all + &coefficient,
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

/// The constant of a polynomial.
fn first_of(terms: &[Number]) -> Number {
    terms.first().cloned().unwrap_or_else(Number::zero)
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

/// The pose of the second body in the first; `None` where its quaternion is zero, which means the pose drawn.
fn relative_pose(pose: Attribute<'_>) -> Outcome<Option<Frame>> {
    let [x, y, z, w, i, j, k]: [Number; 7] = exactly(pose)?;
    let turned = roll_pitch_yaw(&[i, j, k, w]);
    Ok(turned.map(|roll_pitch_yaw| Frame {
        position: [x, y, z],
        roll_pitch_yaw,
    }))
}
