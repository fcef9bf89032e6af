//! What couples joints in MJCF: equalities of two joints, of tendons that add up several.

use super::mjcf::Mjcf;
use super::place::{rounded, text};
use kutzbach_format::escaped;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::Coupling;

impl Mjcf<'_> {
    /// All couplings. MuJoCo counts joints from the pose drawn, as tree joints count here; closing joints need not.
    pub(super) fn couplings(&mut self) {
        let mechanism = self.mechanism;
        for coupling in mechanism.couplings() {
            if self.couple(coupling).is_none() {
                self.not_said.push(format!("coupling `{}`", coupling.name));
            }
        }
    }

    fn couple(&mut self, coupling: &Coupling) -> Option<()> {
        let mut terms: Vec<(String, Number)> = Vec::new();
        let mut shift = 0.0;
        for term in &coupling.terms {
            let joint = self.variables.get(term.joint.0)?.clone()?;
            shift += term.factor.value() * self.drawn_at(term.joint);
            terms.push((joint, term.factor.clone()));
        }
        let offset = match shift == 0.0 {
            true => coupling.offset.clone(),
            false => rounded(coupling.offset.value() - shift),
        };
        let name = self.unused(&coupling.name);
        match &terms[..] {
            [(only, a)] => {
                let at = offset.checked_div(a).ok()?;
                self.polynomial(&name, only, None, &at, None);
            }
            [(follower, a), (leader, b)] => {
                let at = offset.checked_div(a).ok()?;
                let ratio = (-b).checked_div(a).ok()?;
                self.polynomial(&name, follower, Some(leader.as_str()), &at, Some(&ratio));
            }
            _ => self.sum(&name, &terms, &offset),
        }
        Some(())
    }

    /// `joint1 = constant + ratio · joint2`.
    pub(super) fn polynomial(
        &mut self,
        name: &str,
        follower: &str,
        leader: Option<&str>,
        constant: &Number,
        ratio: Option<&Number>,
    ) {
        let (name, follower) = (escaped(name), escaped(follower));
        let second = leader.map(|leader| format!(" joint2=\"{}\"", escaped(leader)));
        let ratio = ratio.map_or_else(|| "0".to_owned(), text);
        self.equalities.push(format!(
            "<joint name=\"{name}\" joint1=\"{follower}\"{} polycoef=\"{} {ratio} 0 0 0\"/>",
            second.unwrap_or_default(),
            text(constant),
        ));
    }

    /// A tendon that adds joints up, held at a length.
    fn sum(&mut self, name: &str, terms: &[(String, Number)], length: &Number) {
        let tendon = escaped(name).into_owned();
        self.tendons.push(format!("<fixed name=\"{tendon}\">"));
        for (joint, factor) in terms {
            self.tendons.push(format!(
                "  <joint joint=\"{}\" coef=\"{}\"/>",
                escaped(joint),
                text(factor)
            ));
        }
        self.tendons.push("</fixed>".to_owned());
        self.equalities.push(format!(
            "<tendon name=\"{tendon}\" tendon1=\"{tendon}\" polycoef=\"{} 0 0 0 0\"/>",
            text(length)
        ));
    }
}
