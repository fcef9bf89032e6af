//! Reading expressions: operator precedence by two stacks (Dijkstra 1961), so that no depth of nesting recurses.

use super::Number;
use super::decimal;
use super::error::{NumberError, Reason};
use super::token::{Token, Tokens};
use super::tree::{MAX_NODES, Operation};
use dashu_base::BitTest;

/// Most parentheses and operators open at once.
const MAX_OPEN: usize = 20_000;
/// Largest size of the binary exponent of a value.
const MAX_EXPONENT: i64 = 20_000;

/// How a name is looked up; see [`Number::expression`].
type Lookup<'a> = dyn FnMut(&str) -> Result<Option<Number>, String> + 'a;

pub(super) fn parse(text: &str, lookup: &mut Lookup<'_>) -> Result<Number, NumberError> {
    let mut tokens = Tokens::new(text);
    let mut parser = Parser {
        values: Vec::new(),
        pending: Vec::new(),
        lookup,
    };
    let mut expects_operand = true;
    while let Some((offset, token)) = tokens.next()? {
        expects_operand = if expects_operand {
            parser.operand(token, offset, &mut tokens)?
        } else {
            parser.operator(token, offset)?
        };
    }
    parser.finish(text.len(), expects_operand)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Function {
    Sqrt,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Abs,
    Radians,
}

const FUNCTIONS: [(&str, Function, usize); 10] = [
    ("sqrt", Function::Sqrt, 1),
    ("sin", Function::Sin, 1),
    ("cos", Function::Cos, 1),
    ("tan", Function::Tan, 1),
    ("asin", Function::Asin, 1),
    ("acos", Function::Acos, 1),
    ("atan", Function::Atan, 1),
    ("atan2", Function::Atan2, 2),
    ("abs", Function::Abs, 1),
    ("radians", Function::Radians, 1),
];

/// Something begun that waits for its last operand.
#[derive(Clone, Copy, Debug)]
enum Pending {
    Binary(Binary),
    Negate,
    Open,
    /// A call with the arguments that are complete.
    Call {
        index: usize,
        complete: usize,
    },
}

impl Pending {
    /// Higher binds tighter; parentheses bind nothing outside.
    fn precedence(self) -> u8 {
        match self {
            Self::Open | Self::Call { .. } => 0,
            Self::Binary(Binary::Add | Binary::Subtract) => 1,
            Self::Binary(Binary::Multiply | Binary::Divide) => 2,
            Self::Negate => 3,
            Self::Binary(Binary::Power) => 4,
        }
    }
}

struct Parser<'a, 'b> {
    /// Complete operands and where they begin.
    values: Vec<(Number, usize)>,
    pending: Vec<(Pending, usize)>,
    lookup: &'a mut Lookup<'b>,
}

const OPERAND: &str = "a number, a name, a function or `(`";
const OPERATOR: &str = "an operator or the end";

fn syntax(needed: &'static str, found: String, offset: usize) -> NumberError {
    Reason::Syntax { needed, found }.at(offset)
}

impl Parser<'_, '_> {
    /// Takes a word where an operand is expected; returns whether one is still expected.
    fn operand(
        &mut self,
        token: Token<'_>,
        offset: usize,
        tokens: &mut Tokens<'_>,
    ) -> Result<bool, NumberError> {
        match token {
            Token::Decimal(text) => {
                let decimal = decimal::parse(text).map_err(|error| error.moved(offset))?;
                let value = Number::from_rational(decimal.value);
                self.values.push((value, offset));
                Ok(false)
            }
            Token::Name("pi") => {
                self.values.push((Number::pi(), offset));
                Ok(false)
            }
            Token::Name(name) => match FUNCTIONS.iter().position(|(known, ..)| *known == name) {
                Some(index) => match tokens.next()? {
                    Some((_, Token::Open)) => {
                        self.begin(Pending::Call { index, complete: 0 }, offset)?;
                        Ok(true)
                    }
                    Some((at, other)) => Err(syntax("`(` after a function", other.shown(), at)),
                    None => Err(syntax("`(` after a function", "the end".to_owned(), offset)),
                },
                None => {
                    let value = (self.lookup)(name).map_err(|message| {
                        Reason::BadName {
                            name: name.to_owned(),
                            message,
                        }
                        .at(offset)
                    })?;
                    let unknown = || Reason::UnknownName(decimal::excerpt(name)).at(offset);
                    self.values.push((value.ok_or_else(unknown)?, offset));
                    Ok(false)
                }
            },
            Token::Open => self.begin(Pending::Open, offset).map(|()| true),
            Token::Minus => self.begin(Pending::Negate, offset).map(|()| true),
            Token::Plus => Ok(true),
            other => Err(syntax(OPERAND, other.shown(), offset)),
        }
    }

    /// Takes a word where an operator is expected; returns whether an operand is expected after it.
    fn operator(&mut self, token: Token<'_>, offset: usize) -> Result<bool, NumberError> {
        let binary = match token {
            Token::Plus => Binary::Add,
            Token::Minus => Binary::Subtract,
            Token::Times => Binary::Multiply,
            Token::Divide => Binary::Divide,
            Token::Power => Binary::Power,
            Token::Comma => return self.comma(offset).map(|()| true),
            Token::Close => return self.close(offset).map(|()| false),
            Token::Open => return Err(self.call_of_a_non_function(offset)),
            other => return Err(syntax(OPERATOR, other.shown(), offset)),
        };
        let pending = Pending::Binary(binary);
        // `**` groups to the right: an equal one waits. Everything else groups to the left.
        let tightness = pending.precedence() + u8::from(binary == Binary::Power);
        self.complete(tightness)?;
        self.begin(pending, offset)?;
        Ok(true)
    }

    /// `name(`: the name was taken for a value.
    fn call_of_a_non_function(&self, offset: usize) -> NumberError {
        syntax(
            "an operator or the end (only functions take parentheses)",
            Token::Open.shown(),
            offset,
        )
    }

    fn begin(&mut self, pending: Pending, offset: usize) -> Result<(), NumberError> {
        if self.pending.len() >= MAX_OPEN {
            return Err(Reason::TooLarge {
                needed: "at most 20000 operators and parentheses open at once",
                found: "more".to_owned(),
            }
            .at(offset));
        }
        self.pending.push((pending, offset));
        Ok(())
    }

    /// Computes everything pending that binds at least as tightly, back to the last open parenthesis.
    fn complete(&mut self, precedence: u8) -> Result<(), NumberError> {
        while let Some(&(pending, offset)) = self.pending.last() {
            let value = match pending {
                _ if pending.precedence() < precedence.max(1) => break,
                Pending::Negate => {
                    let (operand, _) = self.pop(offset)?;
                    (-&operand, offset)
                }
                Pending::Binary(binary) => {
                    let (right, right_offset) = self.pop(offset)?;
                    let (left, left_offset) = self.pop(offset)?;
                    let result = apply(binary, &left, &right, [left_offset, right_offset])?;
                    (result, left_offset)
                }
                Pending::Open | Pending::Call { .. } => break,
            };
            self.pending.pop();
            check_size(&value.0, offset)?;
            self.values.push(value);
        }
        Ok(())
    }

    fn pop(&mut self, offset: usize) -> Result<(Number, usize), NumberError> {
        let missing = || syntax(OPERAND, "nothing".to_owned(), offset);
        self.values.pop().ok_or_else(missing)
    }

    fn comma(&mut self, offset: usize) -> Result<(), NumberError> {
        self.complete(0)?;
        match self.pending.last_mut() {
            Some((Pending::Call { complete, .. }, _)) => {
                *complete += 1;
                Ok(())
            }
            Some(_) => Err(syntax("an operator or `)`", Token::Comma.shown(), offset)),
            None => Err(syntax(OPERATOR, Token::Comma.shown(), offset)),
        }
    }

    fn close(&mut self, offset: usize) -> Result<(), NumberError> {
        self.complete(0)?;
        match self.pending.pop() {
            Some((Pending::Call { index, complete }, start)) => {
                let (name, function, needed) = FUNCTIONS[index];
                let found = complete + 1;
                if found != needed {
                    return Err(Reason::Arguments {
                        function: name,
                        needed,
                        found,
                    }
                    .at(start));
                }
                let mut arguments = Vec::with_capacity(needed);
                for _ in 0..needed {
                    arguments.insert(0, self.pop(start)?.0);
                }
                let value = call(function, &arguments).map_err(|error| error.moved(start))?;
                check_size(&value, start)?;
                self.values.push((value, start));
                Ok(())
            }
            Some((_, start)) => {
                if let Some(value) = self.values.last_mut() {
                    value.1 = start;
                }
                Ok(())
            }
            None => Err(syntax(OPERATOR, Token::Close.shown(), offset)),
        }
    }

    fn finish(mut self, end: usize, expects_operand: bool) -> Result<Number, NumberError> {
        if expects_operand {
            return Err(syntax(OPERAND, "the end".to_owned(), end));
        }
        self.complete(0)?;
        if let Some((_, start)) = self.pending.last() {
            return Err(syntax(
                "`)` for every `(`",
                "one that is not closed".to_owned(),
                *start,
            ));
        }
        self.pop(end).map(|(value, _)| value)
    }
}

fn apply(
    binary: Binary,
    left: &Number,
    right: &Number,
    offsets: [usize; 2],
) -> Result<Number, NumberError> {
    // Before the operators replace it by its digits.
    if left.nodes().saturating_add(right.nodes()) >= MAX_NODES {
        return Err(too_long(offsets[0]));
    }
    match binary {
        Binary::Add => Ok(left + right),
        Binary::Subtract => Ok(left - right),
        Binary::Multiply => Ok(left * right),
        Binary::Divide => left
            .checked_div(right)
            .map_err(|error| error.moved(offsets[1])),
        Binary::Power => left.half_power(right).map_err(|error| {
            let blamed = usize::from(matches!(error.reason, Reason::Exponent(_)));
            error.moved(offsets[blamed])
        }),
    }
}

fn call(function: Function, arguments: &[Number]) -> Result<Number, NumberError> {
    // The number of arguments has been checked.
    let zero = Number::zero();
    let x = arguments.first().unwrap_or(&zero);
    match function {
        Function::Sqrt => x.sqrt(),
        Function::Sin => Ok(x.cos_sin().1),
        Function::Cos => Ok(x.cos_sin().0),
        Function::Tan => x.tan(),
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
        Function::Atan => x.closed("atan").map(|()| x.atan()),
        Function::Atan2 => Number::atan2(x, arguments.get(1).unwrap_or(&zero)),
        Function::Abs => x.closed("abs").map(|()| x.abs()),
        Function::Radians => Ok(x.radians()),
    }
}

fn too_long(offset: usize) -> NumberError {
    Reason::TooLarge {
        needed: "at most 10000 operations",
        found: "more".to_owned(),
    }
    .at(offset)
}

/// Refuses what is too long or too large to be worked with.
fn check_size(value: &Number, offset: usize) -> Result<(), NumberError> {
    let Some(tree) = value.tree() else {
        return Ok(());
    };
    if matches!(tree.operation, Operation::Stored(_)) || tree.nodes() > MAX_NODES {
        return Err(too_long(offset));
    }
    let too_large = |found: String| {
        Err(Reason::TooLarge {
            needed: "a value between 2^-20000 and 2^20000 in size",
            found,
        }
        .at(offset))
    };
    match value.ball(super::evaluate::COARSE) {
        Ok(ball) => {
            let repr = ball.middle.repr();
            let exponent = repr.exponent() as i64 + repr.significand().bit_len() as i64;
            let known = ball.sign().is_some();
            if known && exponent.abs() > MAX_EXPONENT || ball.most().log2() > MAX_EXPONENT {
                return too_large(format!("about 2^{exponent}"));
            }
            Ok(())
        }
        Err(super::ball::Unclear::Range) => too_large("one far beyond".to_owned()),
        Err(super::ball::Unclear::Precision) => Ok(()),
    }
}
