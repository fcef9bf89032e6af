//! What couples joints in MJCF: equalities of two joints, of tendons that add up several.

use super::mjcf::Mjcf;
use super::place::{rounded, text};
use kutzbach_closure::CouplingShare;
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
        let mut terms: Vec<(String, Vec<Number>)> = Vec::new();
        let mut shift = 0.0;
        for term in &coupling.terms {
            let joint = self.variables.get(term.joint.0)?.clone()?;
            let share = CouplingShare {
                joint: term.joint.0,
                coefficients: term.factors().map(Number::value).collect(),
            };
            let drawn_at = self.drawn_at(term.joint);
            let developed = share.taylor(&drawn_at);
            shift += developed[0];
            // A factor that does not change keeps its text.
            let same = drawn_at == 0.0 || term.higher.is_empty();
            let factors = match same {
                true => term.factors().cloned().collect(),
                false => developed[1..].iter().map(|x| rounded(*x)).collect(),
            };
            terms.push((joint, factors));
        }
        let offset = match shift == 0.0 {
            true => coupling.offset.clone(),
            false => rounded(coupling.offset.value() - shift),
        };
        let name = self.unused(&coupling.name);
        let over = |x: &Number, a: &Number| x.checked_div(a).ok();
        match &terms[..] {
            [(only, factors)] => {
                let [a] = &factors[..] else { return None };
                self.polynomial(&name, only, None, &[over(&offset, a)?]);
            }
            [one, other] => {
                let follows = |(_, factors): &(String, Vec<Number>)| factors.len() == 1;
                let (follower, leader) = match (follows(one), follows(other)) {
                    (true, _) => (one, other),
                    (false, true) => (other, one),
                    (false, false) => return None,
                };
                let a = &follower.1[0];
                let mut coefficients = vec![over(&offset, a)?];
                for factor in &leader.1 {
                    coefficients.push(over(&-factor, a)?);
                }
                self.polynomial(&name, &follower.0, Some(leader.0.as_str()), &coefficients);
            }
            _ => {
                let linear = terms.into_iter().map(|(joint, factors)| {
                    let [factor] = <[Number; 1]>::try_from(factors).ok()?;
                    Some((joint, factor))
                });
                let linear: Vec<(String, Number)> = linear.collect::<Option<_>>()?;
                self.sum(&name, &linear, &offset);
            }
        }
        Some(())
    }

    /// `joint1` is a polynomial of `joint2`; these are its coefficients, the constant first.
    pub(super) fn polynomial(
        &mut self,
        name: &str,
        follower: &str,
        leader: Option<&str>,
        coefficients: &[Number],
    ) {
        let (name, follower) = (escaped(name), escaped(follower));
        let second = leader.map(|leader| format!(" joint2=\"{}\"", escaped(leader)));
        let mut polynomial: Vec<String> = coefficients.iter().map(text).collect();
        polynomial.resize(5, "0".to_owned());
        self.equalities.push(format!(
            "<joint name=\"{name}\" joint1=\"{follower}\"{} polycoef=\"{}\"/>",
            second.unwrap_or_default(),
            polynomial.join(" "),
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
