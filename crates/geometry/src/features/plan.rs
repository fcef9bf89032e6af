//! From a declaration to steps over a table of tuples.

use super::declare::{Bend, Condition, Declaration, Sort};
use super::parse::{Criterion, Recognition, concerns};

/// What a step does to the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Fills a role with every face or edge.
    Seed(usize),
    /// Fills the empty ones among two faces and the edge between them.
    Join {
        /// The first face.
        first: usize,
        /// The second face.
        second: usize,
        /// The edge.
        edge: usize,
    },
    /// Fills nothing.
    Verify,
}

/// A step of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanStep {
    /// What it fills.
    pub action: Action,
    /// What is asked of the rows then; the others are struck out.
    pub conditions: Vec<Condition>,
    /// The author's words; none of a step that the plan adds by itself.
    pub authored: Option<String>,
}

/// How the tuples of a feature are looked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The steps in order.
    pub steps: Vec<PlanStep>,
}

impl Declaration {
    /// The plan: the author's steps in their order, and what they leave open after them. A condition is asked as soon as its
    /// roles are filled, unless a later `verify` is about it.
    #[must_use]
    pub fn plan(&self) -> Plan {
        let mut compiler = Compiler {
            declaration: self,
            filled: vec![false; self.roles.len()],
            asked: vec![false; self.conditions.len()],
            plan: Plan { steps: Vec::new() },
        };
        for (number, step) in self.recognition.iter().enumerate() {
            let later = self.recognition.get(number + 1..).unwrap_or_default();
            compiler.author(step, later);
        }
        compiler.complete();
        compiler.plan
    }
}

impl Declaration {
    /// A step in words: the author's, or what the plan does by itself, and what is asked then.
    #[must_use]
    pub fn step_text(&self, step: &PlanStep) -> String {
        let name = |role: usize| self.role_name(role);
        let action = match (&step.authored, step.action) {
            (Some(text), _) => text.clone(),
            (None, Action::Seed(role)) => format!("(then) every {}", name(role)),
            (
                None,
                Action::Join {
                    first,
                    second,
                    edge,
                },
            ) => format!(
                "(then) {} beside {} at {}",
                name(first),
                name(second),
                name(edge)
            ),
            (None, Action::Verify) => "(then) what is left".to_owned(),
        };
        let asked: Vec<String> = step
            .conditions
            .iter()
            .map(|c| self.condition_text(*c))
            .collect();
        match asked.is_empty() {
            true => action,
            false => format!("{action}: {}", asked.join(", ")),
        }
    }
}

struct Compiler<'a> {
    declaration: &'a Declaration,
    /// Which roles are filled so far.
    filled: Vec<bool>,
    /// Which conditions were asked so far.
    asked: Vec<bool>,
    plan: Plan,
}

impl Compiler<'_> {
    fn is_filled(&self, role: usize) -> bool {
        self.filled.get(role).copied().unwrap_or(true)
    }

    fn author(&mut self, step: &Recognition, later: &[Recognition]) {
        let mut text = Some(step.text.clone());
        if !step.finds {
            let about = |c: &&Condition| concerns(c, step.criterion, &step.roles, &step.with);
            // What a later step fills cannot be verified yet; it is asked when it is filled.
            let is_ready = |c: &&Condition| c.roles().iter().all(|role| self.is_filled(*role));
            let named = self.declaration.conditions.iter().filter(about);
            let ready: Vec<Condition> = named.filter(is_ready).copied().collect();
            self.push(Action::Verify, ready, text, later);
            return;
        }
        if step.criterion == Criterion::Connectivity {
            for condition in self.declaration.conditions.clone() {
                let Condition::Connected {
                    first,
                    second,
                    edge,
                } = condition
                else {
                    continue;
                };
                if concerns(&condition, step.criterion, &step.roles, &step.with) {
                    let action = Action::Join {
                        first,
                        second,
                        edge,
                    };
                    self.push(action, Vec::new(), text.take(), later);
                }
            }
        } else {
            for role in &step.roles {
                if !self.is_filled(*role) {
                    self.push(Action::Seed(*role), Vec::new(), text.take(), later);
                }
            }
        }
        if text.is_some() {
            // Steps before it have filled its roles.
            self.push(Action::Verify, Vec::new(), text, later);
        }
    }

    /// Adds a step that asks for some conditions, and for all that can be asked then.
    fn push(
        &mut self,
        action: Action,
        mut conditions: Vec<Condition>,
        authored: Option<String>,
        later: &[Recognition],
    ) {
        let filled = match action {
            Action::Seed(role) => vec![role],
            Action::Join {
                first,
                second,
                edge,
            } => vec![first, second, edge],
            Action::Verify => Vec::new(),
        };
        for role in filled {
            if let Some(mark) = self.filled.get_mut(role) {
                *mark = true;
            }
        }
        for (number, condition) in self.declaration.conditions.iter().enumerate() {
            let waits = later.iter().any(|step| {
                !step.finds && concerns(condition, step.criterion, &step.roles, &step.with)
            });
            let is_ready = condition.roles().iter().all(|role| self.is_filled(*role));
            let asked = self.asked.get(number).copied().unwrap_or(true);
            if is_ready && !asked && !waits && !conditions.contains(condition) {
                conditions.push(*condition);
            }
        }
        for (number, condition) in self.declaration.conditions.iter().enumerate() {
            if let (true, Some(mark)) = (conditions.contains(condition), self.asked.get_mut(number))
            {
                *mark = true;
            }
        }
        self.plan.steps.push(PlanStep {
            action,
            conditions,
            authored,
        });
    }

    /// Fills what the author's steps left empty: along connections where something is filled, from rare edges elsewhere.
    fn complete(&mut self) {
        while self.filled.iter().any(|filled| !filled) {
            let open = self.declaration.conditions.iter().find_map(|condition| {
                let Condition::Connected {
                    first,
                    second,
                    edge,
                } = *condition
                else {
                    return None;
                };
                let count = [first, second, edge]
                    .into_iter()
                    .filter(|r| self.is_filled(*r))
                    .count();
                (1..3).contains(&count).then_some(Action::Join {
                    first,
                    second,
                    edge,
                })
            });
            let action = open.unwrap_or_else(|| Action::Seed(self.rarest()));
            self.push(action, Vec::new(), None, &[]);
        }
        let asked = self.asked.iter().all(|asked| *asked);
        if !asked {
            self.push(Action::Verify, Vec::new(), None, &[]);
        }
    }

    /// The role to begin with: of those that are empty a concave edge, then any edge, then a face.
    fn rarest(&self) -> usize {
        let roles = &self.declaration.roles;
        let empty: Vec<usize> = (0..roles.len())
            .filter(|role| !self.is_filled(*role))
            .collect();
        let is_concave = |role: &usize| {
            let bend = Condition::Bend(*role, Bend::Concave);
            self.declaration.conditions.contains(&bend)
        };
        let is_edge = |role: &usize| roles.get(*role).is_some_and(|r| r.sort == Sort::Edge);
        let all = || empty.iter().copied();
        let first = all().find(is_concave).or_else(|| all().find(is_edge));
        first.or_else(|| all().next()).unwrap_or_default()
    }
}
