//! From text to declarations.

use super::declare::{Bend, Condition, Declaration, Orientation, Role, Sort, Type};
use crate::text::{Cursor, TextError, Token, TokenKind, tokens};
use std::ops::Range;

/// With these words sections begin; no role has one for a name.
const SECTIONS: [&str; 9] = [
    "ENTITIES",
    "EDGE",
    "FACE",
    "CONNECTIVITY",
    "ORIENTATION",
    "POSITION",
    "END",
    "BEGIN",
    "DEFINITION",
];

/// By what a step of the author finds or verifies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Criterion {
    Type,
    Convexity,
    Connectivity,
    Orientation,
    Position,
}

/// A step of the author.
#[derive(Clone, Debug)]
pub(super) struct Recognition {
    /// Whether it fills roles; otherwise it verifies.
    pub(super) finds: bool,
    pub(super) roles: Vec<usize>,
    pub(super) criterion: Criterion,
    pub(super) with: Vec<usize>,
    /// The text of the step.
    pub(super) text: String,
}

/// Reads one declaration after the other.
///
/// # Errors
/// At the first thing that is no part of a declaration, with its place, what was needed and what was found.
pub fn read_declarations(source: &str) -> Result<Vec<Declaration>, TextError> {
    let mut tokens = tokens(source)?;
    tokens.retain(|token| token.kind != TokenKind::LineEnd);
    let mut parser = Parser {
        cursor: Cursor::new(source, &tokens),
        found: empty(),
    };
    let mut found = Vec::new();
    loop {
        found.push(parser.declaration()?);
        if parser.cursor.is_done() {
            return Ok(found);
        }
    }
}

fn empty() -> Declaration {
    Declaration {
        name: String::new(),
        roles: Vec::new(),
        conditions: Vec::new(),
        recognition: Vec::new(),
    }
}

struct Parser<'a> {
    cursor: Cursor<'a>,
    found: Declaration,
}

impl<'a> Parser<'a> {
    fn declaration(&mut self) -> Result<Declaration, TextError> {
        self.keyword("DEFINITION")?;
        self.keyword("NAME")?;
        let name = self.cursor.word("a name for the feature")?;
        self.found.name = name.text.to_owned();
        self.cursor.sign(";", "`;`")?;
        loop {
            if self.cursor.take_word("END") {
                break;
            }
            self.section()?;
        }
        self.keyword("DEFINITION")?;
        if self.found.roles.is_empty() {
            let message = "needed a role or more in ENTITIES, found none";
            return Err(TextError::at(
                self.cursor.source(),
                name.span.clone(),
                message,
            ));
        }
        if self.cursor.take_word("BEGIN") {
            while !self.cursor.take_word("END") {
                let step = self.recognition()?;
                self.found.recognition.push(step);
            }
        }
        Ok(std::mem::replace(&mut self.found, empty()))
    }

    fn keyword(&mut self, word: &str) -> Result<(), TextError> {
        match self.cursor.take_word(word) {
            true => Ok(()),
            false => Err(self.cursor.needed(format!("`{word}`"))),
        }
    }

    fn section(&mut self) -> Result<(), TextError> {
        let statement: fn(&mut Self) -> Result<(), TextError> = if self.cursor.take_word("ENTITIES")
        {
            Self::entities
        } else if self.cursor.take_word("EDGE") || self.cursor.take_word("FACE") {
            self.keyword("TYPE")?;
            Self::types
        } else if self.cursor.take_word("CONNECTIVITY") {
            Self::connectivity
        } else if self.cursor.take_word("ORIENTATION") {
            Self::orientation
        } else if self.cursor.take_word("POSITION") {
            Self::position
        } else {
            let needed = "`ENTITIES`, `EDGE TYPE`, `FACE TYPE`, `CONNECTIVITY`, `ORIENTATION`, `POSITION` or `END DEFINITION`";
            return Err(self.cursor.needed(needed));
        };
        self.cursor.sign(":", "`:`")?;
        while !self.at_section() {
            statement(self)?;
            self.cursor.sign(";", "`;`")?;
        }
        Ok(())
    }

    fn at_section(&self) -> bool {
        self.cursor.peek().is_some_and(|token| {
            token.kind == TokenKind::Word
                && SECTIONS
                    .iter()
                    .any(|word| token.text.eq_ignore_ascii_case(word))
        })
    }

    /// Names with commas between them.
    fn names(&mut self, needed: &str) -> Result<Vec<&'a Token<'a>>, TextError> {
        let mut names = vec![self.cursor.word(needed)?];
        while self.cursor.take_sign(",") {
            names.push(self.cursor.word(needed)?);
        }
        Ok(names)
    }

    fn entities(&mut self) -> Result<(), TextError> {
        let names = self.names("a name for a role")?;
        self.cursor.sign(":", "`,` and another role, or `:`")?;
        let sort = if self.cursor.take_word("FACE") {
            Sort::Face
        } else if self.cursor.take_word("EDGE") {
            Sort::Edge
        } else {
            return Err(self.cursor.needed("`FACE` or `EDGE`"));
        };
        for name in names {
            if self.found.roles.iter().any(|role| role.name == name.text) {
                let message = format!("needed another name, found the role `{}` again", name.text);
                return Err(TextError::at(
                    self.cursor.source(),
                    name.span.clone(),
                    message,
                ));
            }
            self.found.roles.push(Role {
                name: name.text.to_owned(),
                sort,
            });
        }
        Ok(())
    }

    /// A role by its name, of this sort where one is given.
    fn role(&self, token: &Token<'_>, sort: Option<Sort>) -> Result<usize, TextError> {
        let number = self
            .found
            .roles
            .iter()
            .position(|role| role.name == token.text);
        let role = number.and_then(|number| self.found.roles.get(number));
        let needed = match (role, sort) {
            (None, _) => "a role of ENTITIES".to_owned(),
            (Some(role), Some(sort)) if role.sort != sort => match sort {
                Sort::Face => "a role that is a face".to_owned(),
                Sort::Edge => "a role that is an edge".to_owned(),
            },
            _ => return Ok(number.unwrap_or_default()),
        };
        let source = self.cursor.source();
        Err(TextError::needed(
            source,
            token.span.clone(),
            needed,
            token.shown(),
        ))
    }

    fn types(&mut self) -> Result<(), TextError> {
        let names = self.names("a role")?;
        self.cursor.sign(":", "`,` and another role, or `:`")?;
        let word = self.cursor.word("a type")?;
        let kind = Type::ALL.into_iter().find(|kind| is_word(word, *kind));
        let bend = [Bend::Convex, Bend::Concave];
        let bend = bend.into_iter().find(|bend| is_word(word, *bend));
        for name in names {
            let condition = match (kind, bend) {
                (Some(kind), _) => Condition::Type(self.role(name, Some(kind.sort()))?, kind),
                (None, Some(bend)) => Condition::Bend(self.role(name, None)?, bend),
                (None, None) => {
                    let needed = "STRAIGHT or CIRCULAR for an edge; PLANAR, SIMPLE (flat without holes), PIERCED, CYLINDRICAL, CONICAL, SPHERICAL or WHOLE (all around its axis) for a face; CONVEX or CONCAVE for both";
                    let span = word.span.clone();
                    return Err(TextError::needed(
                        self.cursor.source(),
                        span,
                        needed,
                        word.shown(),
                    ));
                }
            };
            self.found.conditions.push(condition);
        }
        Ok(())
    }

    fn connectivity(&mut self) -> Result<(), TextError> {
        let first = self.cursor.word("a role")?;
        let first = self.role(first, Some(Sort::Face))?;
        self.cursor.sign(":", "`:`")?;
        loop {
            self.cursor.sign(
                "(",
                "`(`, the other face, the edge between both and how it bends",
            )?;
            let second = self.cursor.word("the other face")?;
            let second = self.role(second, Some(Sort::Face))?;
            self.cursor
                .sign(",", "`,` and the edge between both faces")?;
            let edge = self.cursor.word("the edge between both faces")?;
            let edge = self.role(edge, Some(Sort::Edge))?;
            self.found.conditions.push(Condition::Connected {
                first,
                second,
                edge,
            });
            if self.cursor.take_sign(",") {
                if self.cursor.take_word("CONVEX") {
                    self.found
                        .conditions
                        .push(Condition::Bend(edge, Bend::Convex));
                } else if self.cursor.take_word("CONCAVE") {
                    self.found
                        .conditions
                        .push(Condition::Bend(edge, Bend::Concave));
                } else {
                    return Err(self.cursor.needed("`CONVEX` or `CONCAVE`"));
                }
            }
            self.cursor
                .sign(")", "`,` and `CONVEX` or `CONCAVE`, or `)`")?;
            if !self.cursor.take_sign(",") {
                return Ok(());
            }
        }
    }

    fn orientation(&mut self) -> Result<(), TextError> {
        let names = self.names("a role")?;
        self.cursor.sign(":", "`,` and another role, or `:`")?;
        let word = self.cursor.word("an orientation")?;
        let mut all = Orientation::ALL.into_iter();
        let Some(orientation) = all.find(|one| is_word(word, *one)) else {
            let needed =
                "PARALLEL, PERPENDICULAR, COPLANAR, FACING, AWAY, COAXIAL, EQUAL_RADIUS or LARGER";
            let span = word.span.clone();
            return Err(TextError::needed(
                self.cursor.source(),
                span,
                needed,
                word.shown(),
            ));
        };
        let of_faces = orientation.is_of_faces();
        let mut roles = Vec::with_capacity(names.len());
        for name in &names {
            roles.push(self.role(name, of_faces.then_some(Sort::Face))?);
        }
        if roles.len() < 2 {
            return Err(TextError::at(
                self.cursor.source(),
                word.span.clone(),
                "needed two roles or more for an orientation, found one",
            ));
        }
        for (at, first) in roles.iter().enumerate() {
            for second in roles.iter().skip(at + 1) {
                let condition = Condition::Oriented(*first, *second, orientation);
                self.found.conditions.push(condition);
            }
        }
        Ok(())
    }

    fn position(&mut self) -> Result<(), TextError> {
        let names = self.names("a role")?;
        self.cursor.sign(":", "`,` and another role, or `:`")?;
        self.keyword("EQUIDISTANT")?;
        self.keyword("FROM")?;
        let from = self.cursor.word("the role that they are as far from")?;
        let from_role = self.role(from, None)?;
        let mut roles = Vec::with_capacity(names.len());
        for name in names {
            roles.push(self.role(name, None)?);
        }
        let [first, others @ ..] = roles.as_slice() else {
            return Ok(());
        };
        if others.is_empty() {
            return Err(TextError::at(
                self.cursor.source(),
                from.span.clone(),
                "needed two roles or more for a distance, found one",
            ));
        }
        for second in others {
            self.found.conditions.push(Condition::Equidistant {
                first: *first,
                second: *second,
                from: from_role,
            });
        }
        Ok(())
    }

    fn list(&mut self) -> Result<Vec<usize>, TextError> {
        self.cursor.sign("[", "`[` and roles")?;
        let names = self.names("a role")?;
        self.cursor.sign("]", "`,` and another role, or `]`")?;
        names
            .into_iter()
            .map(|name| self.role(name, None))
            .collect()
    }

    fn recognition(&mut self) -> Result<Recognition, TextError> {
        let start = self.cursor.place().start;
        let finds = if self.cursor.take_word("find") {
            true
        } else if self.cursor.take_word("verify") {
            false
        } else {
            return Err(self.cursor.needed("`find`, `verify` or `END`"));
        };
        let roles = self.list()?;
        if finds {
            self.keyword("based")?;
            self.keyword("on")?;
        }
        let criterion = self.criterion()?;
        let with = match self.cursor.take_word("with") || self.cursor.take_word("from") {
            true => self.list()?,
            false => Vec::new(),
        };
        let end = self.cursor.behind();
        self.check_step(start..end, finds, &roles, criterion, &with)?;
        // The last step needs none.
        if !self.cursor.take_sign(";") && !self.at_section() {
            return Err(self.cursor.needed("`;` and another step, or `END`"));
        }
        let text = self.cursor.source().get(start..end).unwrap_or_default();
        let words: Vec<&str> = text.split_whitespace().collect();
        Ok(Recognition {
            finds,
            roles,
            criterion,
            with,
            text: words.join(" "),
        })
    }

    fn criterion(&mut self) -> Result<Criterion, TextError> {
        if self.cursor.take_word("edge") {
            if self.cursor.take_word("convexity") {
                return Ok(Criterion::Convexity);
            }
            self.keyword("type")?;
            return Ok(Criterion::Type);
        }
        if self.cursor.take_word("face") {
            if self.cursor.take_word("convexity") {
                return Ok(Criterion::Convexity);
            }
            self.keyword("type")?;
            return Ok(Criterion::Type);
        }
        if self.cursor.take_word("position") {
            return Ok(Criterion::Position);
        }
        if self.cursor.take_word("derived") {
            self.keyword("connectivity")?;
            return Ok(Criterion::Connectivity);
        }
        if self.cursor.take_word("connectivity") {
            return Ok(Criterion::Connectivity);
        }
        match self.cursor.take_word("orientation") {
            true => Ok(Criterion::Orientation),
            false => Err(self.cursor.needed(
                "`edge convexity`, `edge type`, `face convexity`, `face type`, `connectivity`, `derived connectivity`, `orientation` or `position`",
            )),
        }
    }

    /// A step by connectivity, convexity or orientation needs a declaration of it.
    fn check_step(
        &self,
        span: Range<usize>,
        finds: bool,
        roles: &[usize],
        criterion: Criterion,
        with: &[usize],
    ) -> Result<(), TextError> {
        // Any face or edge may be found by its type, also where none is declared.
        if finds && criterion == Criterion::Type {
            return Ok(());
        }
        let about = |condition: &Condition| concerns(condition, criterion, roles, with);
        match self.found.conditions.iter().any(about) {
            true => Ok(()),
            false => {
                let needed = "a step by what the definition declares of these roles";
                Err(TextError::needed(self.cursor.source(), span, needed, "nothing declared")
                    .help("declare it, or leave the step out: all that is declared is enforced without steps too"))
            }
        }
    }
}

/// Whether a step by this criterion is about a condition.
pub(super) fn concerns(
    condition: &Condition,
    criterion: Criterion,
    roles: &[usize],
    with: &[usize],
) -> bool {
    let fits = match condition {
        Condition::Type(..) => criterion == Criterion::Type,
        Condition::Bend(..) => criterion == Criterion::Convexity,
        Condition::Connected { .. } => criterion == Criterion::Connectivity,
        Condition::Oriented(..) => criterion == Criterion::Orientation,
        Condition::Equidistant { .. } => criterion == Criterion::Position,
    };
    let own = condition.roles();
    let names_one = own.iter().any(|role| roles.contains(role));
    fits && names_one && with.iter().all(|role| own.contains(role))
}

fn is_word(token: &Token<'_>, word: impl ToString) -> bool {
    token.text.eq_ignore_ascii_case(&word.to_string())
}
