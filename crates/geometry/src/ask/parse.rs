//! From text to questions and statements.

use super::call::{FUNCTIONS, Function};
use super::term::{Comparison, Goal, Query, Statement, Term, What};
use crate::text::{Cursor, TextError, Token, TokenKind, read_expression};
use kutzbach_math::number::Number;
use std::collections::BTreeMap;

/// Terms and negations may be nested so deep.
const DEEPEST: usize = 32;

/// The signs of comparisons.
const COMPARISONS: [(&str, Comparison); 6] = [
    ("=", Comparison::Equal),
    ("!=", Comparison::Different),
    ("<", Comparison::Less),
    ("<=", Comparison::LessOrEqual),
    (">", Comparison::Greater),
    (">=", Comparison::GreaterOrEqual),
];

/// A question: goals with commas between them.
pub(super) fn query(
    source: &str,
    tokens: &[Token<'_>],
    numbers: &BTreeMap<String, Number>,
) -> Result<Query, TextError> {
    let mut parser = Parser::new(source, tokens, numbers);
    let goals = parser.goals(0)?;
    parser.end()?;
    Ok(Query {
        goals,
        free: parser.free,
    })
}

/// A line of a script.
pub(super) fn statement(
    source: &str,
    tokens: &[Token<'_>],
    numbers: &BTreeMap<String, Number>,
) -> Result<Statement, TextError> {
    let mut parser = Parser::new(source, tokens, numbers);
    let cursor = &parser.cursor;
    let is_word = |token: Option<&Token<'_>>| token.is_some_and(|t| t.kind == TokenKind::Word);
    let second_is = |sign: &str| {
        let second = cursor.peek_second();
        second.is_some_and(|t| t.kind == TokenKind::Sign && t.text == sign)
    };
    let begins_with_word = is_word(cursor.peek());
    let defines = begins_with_word && second_is("=");
    let two_words = begins_with_word && is_word(cursor.peek_second());
    let alone = begins_with_word && cursor.peek_second().is_none();
    if defines {
        return parser.definition();
    }
    if two_words && parser.cursor.take_word("delete") {
        let name = parser.cursor.word("the name of an entity")?;
        let whole = parser.cursor.take_word("with");
        if whole && !parser.cursor.take_word("parts") {
            return Err(parser.cursor.needed("`parts`"));
        }
        parser.end()?;
        return Ok(Statement::Delete(
            name.text.to_owned(),
            name.span.clone(),
            whole,
        ));
    }
    if two_words && parser.cursor.take_word("rename") {
        let name = parser.cursor.word("the name of an entity")?;
        let new = parser.cursor.word("its new name")?;
        parser.end()?;
        let (old, new) = (name.text.to_owned(), new.text.to_owned());
        return Ok(Statement::Rename(old, name.span.clone(), new));
    }
    if alone && parser.cursor.take_word("list") {
        return Ok(Statement::List);
    }
    let goals = parser.goals(0)?;
    parser.end()?;
    Ok(Statement::Ask(Query {
        goals,
        free: parser.free,
    }))
}

struct Parser<'a> {
    cursor: Cursor<'a>,
    numbers: &'a BTreeMap<String, Number>,
    free: Vec<String>,
}

impl<'a> Parser<'a> {
    fn new(
        source: &'a str,
        tokens: &'a [Token<'a>],
        numbers: &'a BTreeMap<String, Number>,
    ) -> Self {
        Self {
            cursor: Cursor::new(source, tokens),
            numbers,
            free: Vec::new(),
        }
    }

    fn end(&self) -> Result<(), TextError> {
        match self.cursor.is_done() {
            true => Ok(()),
            false => Err(self.cursor.needed("`,` and another goal, or the end")),
        }
    }

    fn definition(&mut self) -> Result<Statement, TextError> {
        let name = self.cursor.word("a name")?;
        self.cursor.sign("=", "`=`")?;
        let term = self.term(0)?;
        if !self.cursor.is_done() {
            return Err(self.cursor.needed("the end of the line"));
        }
        if let Some(free) = self.free.first() {
            let message = format!("needed a definition without free names, found `?{free}`");
            return Err(TextError::at(self.cursor.source(), term.span, message));
        }
        Ok(Statement::Define(
            name.text.to_owned(),
            name.span.clone(),
            term,
        ))
    }

    fn goals(&mut self, depth: usize) -> Result<Vec<Goal>, TextError> {
        let mut goals = vec![self.goal(depth)?];
        while self.cursor.take_sign(",") {
            goals.push(self.goal(depth)?);
        }
        Ok(goals)
    }

    fn goal(&mut self, depth: usize) -> Result<Goal, TextError> {
        self.check_depth(depth)?;
        let opens = |t: &Token<'_>| t.kind == TokenKind::Sign && t.text == "(";
        if self.cursor.peek_second().is_some_and(opens) && self.cursor.take_word("not") {
            self.cursor.sign("(", "`(`")?;
            let goals = self.goals(depth + 1)?;
            self.cursor.sign(")", "`,` and another goal, or `)`")?;
            return Ok(Goal::Not(goals));
        }
        let first = self.term(depth)?;
        for (sign, comparison) in COMPARISONS {
            if self.cursor.take_sign(sign) {
                let second = self.term(depth)?;
                return Ok(Goal::Compare(first, comparison, second));
            }
        }
        match first.what {
            What::Call(..) => Ok(Goal::Holds(first)),
            // An entity or a number by itself is shown.
            What::Name(_) => Ok(Goal::Holds(first)),
            _ => Err(self
                .cursor
                .needed("a comparison: `=`, `!=`, `<`, `<=`, `>` or `>=`")),
        }
    }

    fn check_depth(&self, depth: usize) -> Result<(), TextError> {
        match depth < DEEPEST {
            true => Ok(()),
            false => Err(TextError::needed(
                self.cursor.source(),
                self.cursor.place(),
                format!("at most {DEEPEST} parentheses in each other"),
                "more",
            )
            .help("give parts names in a script: `name = ...`")),
        }
    }

    fn term(&mut self, depth: usize) -> Result<Term, TextError> {
        self.check_depth(depth)?;
        let start = self.cursor.place().start;
        let needed = "a name, a free name such as `?f`, a number, a function or a list";
        let Some(token) = self.cursor.peek() else {
            return Err(self.cursor.needed(needed));
        };
        let what = match token.kind {
            TokenKind::Word => {
                self.cursor.take();
                match self.cursor.take_sign("(") {
                    true => self.call(token, depth)?,
                    false => What::Name(token.text.to_owned()),
                }
            }
            TokenKind::Free => {
                self.cursor.take();
                What::Free(self.number_of(token.text.trim_start_matches('?')))
            }
            TokenKind::Number => {
                self.cursor.take();
                let number = Number::decimal(token.text);
                What::Number(number.map_err(|e| self.wrong(token, 0, e.to_string()))?)
            }
            TokenKind::Expression => {
                self.cursor.take();
                What::Number(self.expression(token)?)
            }
            TokenKind::Sign if token.text == "[" => {
                self.cursor.take();
                What::List(self.terms("]", depth)?)
            }
            TokenKind::Sign | TokenKind::LineEnd => return Err(self.cursor.needed(needed)),
        };
        let span = start..self.cursor.behind();
        Ok(Term { what, span })
    }

    fn wrong(&self, token: &Token<'_>, offset: usize, message: String) -> TextError {
        let start = (token.span.start + offset).min(token.span.end);
        TextError::at(self.cursor.source(), start..token.span.end, message)
    }

    fn expression(&self, token: &Token<'_>) -> Result<Number, TextError> {
        let inside = token.text.strip_prefix("${");
        let inside = inside.and_then(|text| text.strip_suffix('}'));
        read_expression::<Number>(inside.unwrap_or_default(), self.numbers)
            .map(|(number, _)| number)
            .map_err(|(offset, message)| self.wrong(token, 2 + offset, message))
    }

    fn number_of(&mut self, name: &str) -> usize {
        match self.free.iter().position(|known| known == name) {
            Some(number) => number,
            None => {
                self.free.push(name.to_owned());
                self.free.len() - 1
            }
        }
    }

    /// Terms with commas between them, and the sign after the last one.
    fn terms(&mut self, closing: &str, depth: usize) -> Result<Vec<Term>, TextError> {
        let mut terms = Vec::new();
        if self.cursor.take_sign(closing) {
            return Ok(terms);
        }
        loop {
            terms.push(self.term(depth + 1)?);
            if self.cursor.take_sign(closing) {
                return Ok(terms);
            }
            let needed = format!("`,` and another term, or `{closing}`");
            self.cursor.sign(",", &needed)?;
        }
    }

    fn call(&mut self, name: &Token<'_>, depth: usize) -> Result<What, TextError> {
        let Some(function) = FUNCTIONS.iter().find(|known| known.name == name.text) else {
            return Err(unknown(self.cursor.source(), name));
        };
        let arguments = self.terms(")", depth)?;
        let count = arguments.len();
        if count < function.least || count > function.most {
            let span = name.span.start..self.cursor.behind();
            let needed = needed_arguments(function);
            return Err(
                TextError::needed(self.cursor.source(), span, needed, count).help(function.form)
            );
        }
        Ok(What::Call(name.text.to_owned(), arguments))
    }
}

fn needed_arguments(function: &Function) -> String {
    let Function {
        name, least, most, ..
    } = function;
    match (least == most, *most == usize::MAX) {
        (true, _) => format!("{least} argument(s) for `{name}`"),
        (false, true) => format!("{least} arguments or more for `{name}`"),
        (false, false) => format!("{least} to {most} arguments for `{name}`"),
    }
}

/// The error about a function that there is not, with those that begin alike.
fn unknown(source: &str, name: &Token<'_>) -> TextError {
    let error = TextError::needed(source, name.span.clone(), "a function", name.shown());
    let first = name.text.chars().next();
    let alike: Vec<&str> = FUNCTIONS
        .iter()
        .map(|function| function.name)
        .filter(|known| known.chars().next() == first)
        .collect();
    match alike.as_slice() {
        [] => error.help("the page on geometry lists the functions"),
        names => error.help(format!("there are {}", names.join(", "))),
    }
}
