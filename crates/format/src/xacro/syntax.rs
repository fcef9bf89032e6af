//! Expressions as trees: the part of Python's expressions that xacro files use.
//!
//! A tree has at most [`MOST_NODES`] nodes, so that walking it recursively needs a bounded stack.

use super::text::Text;
use super::token::{Token, tokens};
use super::value::Value;
use std::rc::Rc;

/// Larger expressions are refused.
const MOST_NODES: usize = 5000;
/// Brackets, signs and conditions inside each other.
const DEEPEST: usize = 100;

pub(super) enum Expr {
    Literal(Value),
    Name(Rc<str>),
    List(Vec<Expr>),
    Tuple(Vec<Expr>),
    Dict(Vec<(Expr, Expr)>),
    Negate(Box<Expr>),
    Plus(Box<Expr>),
    Not(Box<Expr>),
    Binary(Binary, Box<Expr>, Box<Expr>),
    /// `a < b <= c`: the first operand, and each further one with the comparison before it.
    Compare(Box<Expr>, Vec<(Comparison, Expr)>),
    And(Box<Expr>, Box<Expr>),
    Or(Box<Expr>, Box<Expr>),
    /// Condition, value if it holds, value otherwise.
    Choice(Box<[Expr; 3]>),
    Member(Box<Expr>, Rc<str>),
    Index(Box<Expr>, Box<Expr>),
    Slice(Box<Expr>, Box<[Option<Expr>; 3]>),
    Call(Box<Expr>, Vec<Expr>, Vec<(Rc<str>, Expr)>),
    Comprehension(Box<Comprehension>),
}

/// `[value for names in items if condition ...]`; with a key, of a dictionary.
pub(super) struct Comprehension {
    pub(super) key: Option<Expr>,
    pub(super) value: Expr,
    pub(super) clauses: Vec<Clause>,
}

pub(super) enum Clause {
    For(Vec<Rc<str>>, Expr),
    If(Expr),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    FloorDivide,
    Remainder,
    Power,
}

impl Binary {
    pub(super) fn sign(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::FloorDivide => "//",
            Self::Remainder => "%",
            Self::Power => "**",
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Comparison {
    Equal,
    Unequal,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    In,
    NotIn,
    Is,
    IsNot,
}

/// Reads an expression; a fault is a message.
pub(super) fn parse(text: &Text) -> Result<Expr, String> {
    let mut parser = Parser {
        tokens: tokens(text)?,
        at: 0,
        nodes: 0,
        depth: 0,
    };
    if parser.tokens.is_empty() {
        return Err("the expression is empty".to_owned());
    }
    let expression = parser.tuple()?;
    match parser.tokens.get(parser.at) {
        None => Ok(expression),
        Some((token, _)) => Err(format!(
            "needed an operator or the end, found {}",
            shown(token)
        )),
    }
}

struct Parser {
    tokens: Vec<(Token, usize)>,
    at: usize,
    nodes: usize,
    depth: usize,
}

type Parsed<T = Expr> = Result<T, String>;

fn shown(token: &Token) -> String {
    match token {
        Token::Number(number) => format!("`{}`", number.text().as_str()),
        Token::Text(text) => format!("the text `{text}`"),
        Token::Name(name) => format!("`{name}`"),
        Token::Sign(sign) => format!("`{sign}`"),
    }
}

impl Parser {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at).map(|(token, _)| token)
    }

    fn sees(&self, sign: &str) -> bool {
        matches!(self.peek(), Some(Token::Sign(own)) if *own == sign)
    }

    fn take(&mut self, sign: &str) -> bool {
        let found = self.sees(sign);
        self.at += usize::from(found);
        found
    }

    fn need(&mut self, sign: &str) -> Parsed<()> {
        if self.take(sign) {
            return Ok(());
        }
        let found = self.peek().map_or("the end".to_owned(), shown);
        Err(format!("needed `{sign}`, found {found}"))
    }

    fn node(&mut self, expression: Expr) -> Parsed {
        self.nodes += 1;
        if self.nodes > MOST_NODES {
            return Err(format!("the expression has more than {MOST_NODES} parts"));
        }
        Ok(expression)
    }

    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!(
                "the expression is nested more than {DEEPEST} levels deep"
            ));
        }
        let result = read(self);
        self.depth -= 1;
        result
    }

    /// One expression, or several joined by commas.
    fn tuple(&mut self) -> Parsed {
        let first = self.choice()?;
        if !self.sees(",") {
            return Ok(first);
        }
        let mut items = vec![first];
        while self.take(",") {
            if matches!(self.peek(), None | Some(Token::Sign(")"))) {
                break;
            }
            items.push(self.choice()?);
        }
        self.node(Expr::Tuple(items))
    }

    fn choice(&mut self) -> Parsed {
        self.deeper(|parser| {
            let value = parser.or()?;
            if !parser.take("if") {
                return Ok(value);
            }
            let condition = parser.or()?;
            parser.need("else")?;
            let otherwise = parser.choice()?;
            parser.node(Expr::Choice(Box::new([condition, value, otherwise])))
        })
    }

    fn or(&mut self) -> Parsed {
        let mut left = self.and()?;
        while self.take("or") {
            let right = self.and()?;
            left = self.node(Expr::Or(Box::new(left), Box::new(right)))?;
        }
        Ok(left)
    }

    fn and(&mut self) -> Parsed {
        let mut left = self.not()?;
        while self.take("and") {
            let right = self.not()?;
            left = self.node(Expr::And(Box::new(left), Box::new(right)))?;
        }
        Ok(left)
    }

    fn not(&mut self) -> Parsed {
        if !self.take("not") {
            return self.comparison();
        }
        let operand = self.deeper(Self::not)?;
        self.node(Expr::Not(Box::new(operand)))
    }

    fn comparison(&mut self) -> Parsed {
        let first = self.sum()?;
        let mut rest = Vec::new();
        while let Some(comparison) = self.comparison_sign() {
            let operand = self.sum()?;
            rest.push((comparison, operand));
        }
        if rest.is_empty() {
            return Ok(first);
        }
        self.nodes += rest.len();
        self.node(Expr::Compare(Box::new(first), rest))
    }

    fn comparison_sign(&mut self) -> Option<Comparison> {
        let Some(Token::Sign(sign)) = self.peek() else {
            return None;
        };
        let comparison = match *sign {
            "==" => Comparison::Equal,
            "!=" => Comparison::Unequal,
            "<" => Comparison::Less,
            "<=" => Comparison::LessOrEqual,
            ">" => Comparison::Greater,
            ">=" => Comparison::GreaterOrEqual,
            "in" => Comparison::In,
            "is" => {
                self.at += 1;
                let not = self.take("not");
                return Some(if not {
                    Comparison::IsNot
                } else {
                    Comparison::Is
                });
            }
            "not" if matches!(self.tokens.get(self.at + 1), Some((Token::Sign("in"), _))) => {
                self.at += 2;
                return Some(Comparison::NotIn);
            }
            _ => return None,
        };
        self.at += 1;
        Some(comparison)
    }

    fn binary(&mut self, signs: &[(&str, Binary)], operand: fn(&mut Self) -> Parsed) -> Parsed {
        let mut left = operand(self)?;
        loop {
            let Some((_, operator)) = signs.iter().find(|(sign, _)| self.sees(sign)) else {
                return Ok(left);
            };
            self.at += 1;
            let right = operand(self)?;
            left = self.node(Expr::Binary(*operator, Box::new(left), Box::new(right)))?;
        }
    }

    fn sum(&mut self) -> Parsed {
        self.binary(
            &[("+", Binary::Add), ("-", Binary::Subtract)],
            Self::product,
        )
    }

    fn product(&mut self) -> Parsed {
        let signs = [
            ("*", Binary::Multiply),
            ("/", Binary::Divide),
            ("//", Binary::FloorDivide),
            ("%", Binary::Remainder),
        ];
        self.binary(&signs, Self::signed)
    }

    fn signed(&mut self) -> Parsed {
        if self.take("-") {
            let operand = self.deeper(Self::signed)?;
            return self.node(Expr::Negate(Box::new(operand)));
        }
        if self.take("+") {
            let operand = self.deeper(Self::signed)?;
            return self.node(Expr::Plus(Box::new(operand)));
        }
        self.power()
    }

    fn power(&mut self) -> Parsed {
        let base = self.trailers()?;
        if !self.take("**") {
            return Ok(base);
        }
        let exponent = self.deeper(Self::signed)?;
        self.node(Expr::Binary(
            Binary::Power,
            Box::new(base),
            Box::new(exponent),
        ))
    }

    fn trailers(&mut self) -> Parsed {
        let mut value = self.atom()?;
        loop {
            if self.take(".") {
                let Some(Token::Name(name)) = self.peek().cloned() else {
                    return Err("needed a name after `.`".to_owned());
                };
                self.at += 1;
                value = self.node(Expr::Member(Box::new(value), name))?;
            } else if self.take("(") {
                value = self.call(value)?;
            } else if self.take("[") {
                value = self.subscript(value)?;
            } else {
                return Ok(value);
            }
        }
    }

    fn call(&mut self, function: Expr) -> Parsed {
        let mut values = Vec::new();
        let mut named = Vec::new();
        while !self.take(")") {
            let next = self.tokens.get(self.at + 1);
            let name = match (self.peek(), next) {
                (Some(Token::Name(name)), Some((Token::Sign("="), _))) => Some(name.clone()),
                _ => None,
            };
            if let Some(name) = name {
                self.at += 2;
                named.push((name, self.choice()?));
            } else {
                let value = self.choice()?;
                let value = match self.sees("for") {
                    true => self.comprehension(None, value)?,
                    false => value,
                };
                values.push(value);
            }
            if !self.take(",") {
                self.need(")")?;
                break;
            }
        }
        self.node(Expr::Call(Box::new(function), values, named))
    }

    fn subscript(&mut self, value: Expr) -> Parsed {
        let mut parts = [None, None, None];
        let mut index = 0;
        loop {
            if self.take(":") {
                index += 1;
                if index > 2 {
                    return Err("a slice has at most three parts".to_owned());
                }
            } else if self.take("]") {
                break;
            } else if parts[index].is_none() {
                parts[index] = Some(self.choice()?);
            } else {
                self.need("]")?;
            }
        }
        match (index, parts) {
            (0, [Some(at), _, _]) => self.node(Expr::Index(Box::new(value), Box::new(at))),
            (0, _) => Err("needed an index between `[` and `]`".to_owned()),
            (_, parts) => self.node(Expr::Slice(Box::new(value), Box::new(parts))),
        }
    }

    fn atom(&mut self) -> Parsed {
        let token = self.peek().cloned();
        self.at += 1;
        match token {
            Some(Token::Number(number)) => self.node(Expr::Literal(Value::Number(number))),
            Some(Token::Text(text)) => {
                let mut all = text.to_string();
                // Texts that stand side by side are one.
                while let Some(Token::Text(more)) = self.peek() {
                    all.push_str(more);
                    self.at += 1;
                }
                self.node(Expr::Literal(Value::text(&all)))
            }
            Some(Token::Name(name)) => {
                let constant = match &*name {
                    "True" => Some(Value::Bool(true)),
                    "False" => Some(Value::Bool(false)),
                    "None" => Some(Value::None),
                    _ => None,
                };
                self.node(constant.map_or(Expr::Name(name), Expr::Literal))
            }
            Some(Token::Sign("(")) => self.parenthesis(),
            Some(Token::Sign("[")) => self.list(),
            Some(Token::Sign("{")) => self.dictionary(),
            Some(token) => Err(format!("needed a value, found {}", shown(&token))),
            None => Err("needed a value, found the end".to_owned()),
        }
    }

    fn parenthesis(&mut self) -> Parsed {
        if self.take(")") {
            return self.node(Expr::Tuple(Vec::new()));
        }
        let inside = self.tuple()?;
        let inside = match self.sees("for") {
            true => self.comprehension(None, inside)?,
            false => inside,
        };
        self.need(")")?;
        Ok(inside)
    }

    fn list(&mut self) -> Parsed {
        let mut items = Vec::new();
        while !self.take("]") {
            items.push(self.choice()?);
            if self.sees("for") && items.len() == 1 {
                let value = items.remove(0);
                let all = self.comprehension(None, value)?;
                self.need("]")?;
                return Ok(all);
            }
            if !self.take(",") {
                self.need("]")?;
                break;
            }
        }
        self.node(Expr::List(items))
    }

    fn dictionary(&mut self) -> Parsed {
        let mut items = Vec::new();
        while !self.take("}") {
            let key = self.choice()?;
            self.need(":")?;
            let value = self.choice()?;
            if self.sees("for") && items.is_empty() {
                let all = self.comprehension(Some(key), value)?;
                self.need("}")?;
                return Ok(all);
            }
            items.push((key, value));
            if !self.take(",") {
                self.need("}")?;
                break;
            }
        }
        self.node(Expr::Dict(items))
    }

    fn comprehension(&mut self, key: Option<Expr>, value: Expr) -> Parsed {
        let mut clauses = Vec::new();
        loop {
            if self.take("for") {
                let bracketed = self.take("(");
                let mut names = Vec::new();
                while let Some(Token::Name(name)) = self.peek().cloned() {
                    self.at += 1;
                    names.push(name);
                    if !self.take(",") {
                        break;
                    }
                }
                if bracketed {
                    self.need(")")?;
                }
                if names.is_empty() {
                    return Err("needed a name after `for`".to_owned());
                }
                self.need("in")?;
                let items = self.or()?;
                clauses.push(Clause::For(names, items));
            } else if self.take("if") {
                let condition = self.or()?;
                clauses.push(Clause::If(condition));
            } else {
                break;
            }
        }
        self.node(Expr::Comprehension(Box::new(Comprehension {
            key,
            value,
            clauses,
        })))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_told_and_never_panic() {
        for text in [
            "",
            "1 +",
            "(1",
            "a.",
            "a[",
            "a[]",
            "[1, 2",
            "f(1",
            "'a",
            "1 2",
            "{1}",
            "a ? b",
            "x if y",
            "[x for]",
            "not",
            "a[1:2:3:4]",
            "$",
            "lambda x: x",
        ] {
            assert!(parse(&text.into()).is_err(), "{text}");
        }
        let deep = format!("{}1{}", "(".repeat(5000), ")".repeat(5000));
        assert!(parse(&deep.as_str().into()).is_err());
        let long = format!("1{}", "+1".repeat(100_000));
        assert!(parse(&long.as_str().into()).is_err());
        let minus = format!("{}1", "-".repeat(100_000));
        assert!(parse(&minus.as_str().into()).is_err());
    }
}
