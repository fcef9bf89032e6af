//! From tokens to entities by number.

use super::lexer::{Lexer, Span, Token, shortened};
use super::{Entity, Exchange, Leaf, Value, text};
use crate::error::{Problem, StepError};
use std::collections::HashMap;

/// The deepest nesting of lists that is read. Files have three or four.
const DEEPEST: usize = 64;

/// Takes a STEP file apart.
///
/// # Errors
/// Where the text does not follow ISO 10303-21, where two entities have one number, where lists are nested too deep, or where
/// the text is longer than 4 GB.
pub(crate) fn parse(text: &[u8]) -> Result<Exchange<'_>, StepError> {
    if u32::try_from(text.len()).is_err() {
        let problem = Problem::TooMuch {
            what: "bytes of text",
            limit: u64::from(u32::MAX),
        };
        return Err(StepError::at(1, None, problem));
    }
    let mut parser = Parser::new(text);
    parser.file()?;
    parser.finished()
}

struct Parser<'t> {
    text: &'t [u8],
    lexer: Lexer<'t>,
    /// The entity that is read, for messages.
    entity: Option<u64>,
    places: HashMap<&'t [u8], u32>,
    exchange: Exchange<'t>,
}

impl<'t> Parser<'t> {
    fn new(text: &'t [u8]) -> Self {
        Self {
            text,
            lexer: Lexer::new(text),
            entity: None,
            places: HashMap::new(),
            exchange: Exchange {
                text,
                values: Vec::new(),
                leaves: Vec::new(),
                entities: Vec::new(),
                keywords: Vec::new(),
                schemas: Vec::new(),
            },
        }
    }

    fn token(&mut self) -> Result<Token, StepError> {
        let entity = self.entity;
        self.lexer
            .token()
            .map_err(|error| StepError { entity, ..error })
    }

    fn error(&self, problem: Problem) -> StepError {
        StepError::at(self.lexer.line(), self.entity, problem)
    }

    fn unexpected(&self, needed: &str, found: Token) -> StepError {
        self.error(Problem::Syntax {
            needed: needed.to_owned(),
            found: self.shown(found),
        })
    }

    fn shown(&self, token: Token) -> String {
        let quoted = |before: &str, span: Span, after: &str| {
            let words = String::from_utf8_lossy(span.of(self.text));
            format!("`{before}{}{after}`", shortened(&words))
        };
        match token {
            Token::Keyword(span) => quoted("", span, ""),
            Token::Text(span) => quoted("'", span, "'"),
            Token::Enumeration(span) => quoted(".", span, "."),
            Token::Binary(span) => quoted("\"", span, "\""),
            Token::Number(number) => format!("the number {number}"),
            Token::Reference(number) => format!("`#{number}`"),
            Token::Open => "`(`".to_owned(),
            Token::Close => "`)`".to_owned(),
            Token::Comma => "`,`".to_owned(),
            Token::Semicolon => "`;`".to_owned(),
            Token::Equals => "`=`".to_owned(),
            Token::Dollar => "`$`".to_owned(),
            Token::Star => "`*`".to_owned(),
            Token::End => "the end of the file".to_owned(),
        }
    }

    fn expect(&mut self, wanted: Token, needed: &str) -> Result<(), StepError> {
        let token = self.token()?;
        if token == wanted {
            Ok(())
        } else {
            Err(self.unexpected(needed, token))
        }
    }

    fn is_word(&self, span: Span, word: &str) -> bool {
        span.of(self.text).eq_ignore_ascii_case(word.as_bytes())
    }

    /// The whole file: `ISO-10303-21; HEADER; … ENDSEC; DATA; … ENDSEC; END-ISO-10303-21;`.
    fn file(&mut self) -> Result<(), StepError> {
        let needed = "`ISO-10303-21;`, with which a STEP file begins";
        match self.token()? {
            Token::Keyword(span) if self.is_word(span, "ISO-10303-21") => {}
            other => return Err(self.unexpected(needed, other)),
        }
        self.expect(Token::Semicolon, "`;`")?;
        loop {
            match self.token()? {
                Token::Keyword(span) if self.is_word(span, "HEADER") => {
                    self.expect(Token::Semicolon, "`;`")?;
                    self.header()?;
                }
                Token::Keyword(span) if self.is_word(span, "DATA") => self.data()?,
                Token::Keyword(span) if self.is_word(span, "END-ISO-10303-21") => return Ok(()),
                // Sections of the third edition: names for other files, and signatures. What other files hold is missed
                // where something refers to it.
                Token::Keyword(span)
                    if ["ANCHOR", "REFERENCE", "SIGNATURE"]
                        .iter()
                        .any(|word| self.is_word(span, word)) =>
                {
                    self.lexer.skip_section();
                    self.end_of_section()?;
                }
                other => {
                    let needed = "a section (`HEADER;`, `DATA;`) or `END-ISO-10303-21;`";
                    return Err(self.unexpected(needed, other));
                }
            }
        }
    }

    fn end_of_section(&mut self) -> Result<(), StepError> {
        match self.token()? {
            Token::Keyword(span) if self.is_word(span, "ENDSEC") => {
                self.expect(Token::Semicolon, "`;`")
            }
            other => Err(self.unexpected("`ENDSEC;`", other)),
        }
    }

    fn header(&mut self) -> Result<(), StepError> {
        loop {
            match self.token()? {
                Token::Keyword(span) if self.is_word(span, "ENDSEC") => {
                    return self.expect(Token::Semicolon, "`;`");
                }
                Token::Keyword(span) => {
                    let first = self.exchange.values.len();
                    self.expect(Token::Open, "`(`")?;
                    self.parameters()?;
                    self.expect(Token::Semicolon, "`;`")?;
                    if self.is_word(span, "FILE_SCHEMA") {
                        self.schemas(first);
                    }
                    self.exchange.values.truncate(first);
                }
                other => return Err(self.unexpected("an entity of the header or `ENDSEC;`", other)),
            }
        }
    }

    /// Keeps the strings among the values from `first` on: the names of schemas.
    fn schemas(&mut self, first: usize) {
        let values = self.exchange.values.get(first..).unwrap_or_default();
        let names = values.iter().filter_map(|value| match value {
            Value::Text(span) => Some(text::decoded(span.of(self.text))),
            _ => None,
        });
        self.exchange.schemas.extend(names);
    }

    fn data(&mut self) -> Result<(), StepError> {
        match self.token()? {
            Token::Semicolon => {}
            // A section of data with a name and a schema of its own.
            Token::Open => {
                let first = self.exchange.values.len();
                self.parameters()?;
                self.exchange.values.truncate(first);
                self.expect(Token::Semicolon, "`;`")?;
            }
            other => return Err(self.unexpected("`;`", other)),
        }
        loop {
            match self.token()? {
                Token::Keyword(span) if self.is_word(span, "ENDSEC") => {
                    return self.expect(Token::Semicolon, "`;`");
                }
                Token::Reference(number) => self.entity(number)?,
                other => return Err(self.unexpected("an entity (`#1=…;`) or `ENDSEC;`", other)),
            }
        }
    }

    /// An entity behind its number, to the semicolon.
    fn entity(&mut self, number: u64) -> Result<(), StepError> {
        self.entity = Some(number);
        let line = self.lexer.line();
        self.expect(Token::Equals, "`=` behind the number of an entity")?;
        let first = self.exchange.leaves.len();
        match self.token()? {
            Token::Keyword(span) => self.leaf(span)?,
            Token::Open => loop {
                match self.token()? {
                    Token::Keyword(span) => self.leaf(span)?,
                    Token::Close => break,
                    other => return Err(self.unexpected("a keyword or `)`", other)),
                }
            },
            other => return Err(self.unexpected("a keyword or `(`", other)),
        }
        self.expect(Token::Semicolon, "`;` at the end of an entity")?;
        self.exchange.entities.push(Entity {
            number,
            line: u32::try_from(line).unwrap_or(u32::MAX),
            first: first as u32,
            end: self.exchange.leaves.len() as u32,
        });
        self.entity = None;
        Ok(())
    }

    /// A keyword with its parameters.
    fn leaf(&mut self, keyword: Span) -> Result<(), StepError> {
        let keyword = self.keyword(keyword);
        let first = self.exchange.values.len() as u32;
        self.expect(Token::Open, "`(` behind a keyword")?;
        self.parameters()?;
        let end = self.exchange.values.len() as u32;
        self.exchange.leaves.push(Leaf {
            keyword,
            first,
            end,
        });
        Ok(())
    }

    /// The place of a keyword among all keywords.
    fn keyword(&mut self, span: Span) -> u32 {
        let text: &'t [u8] = self.text;
        let word = span.of(text);
        if let Some(place) = self.places.get(word) {
            return *place;
        }
        let capitals = String::from_utf8_lossy(word).to_ascii_uppercase();
        let known = self.exchange.keywords.iter().position(|k| *k == capitals);
        let place = known.unwrap_or(self.exchange.keywords.len()) as u32;
        if known.is_none() {
            self.exchange.keywords.push(capitals);
        }
        self.places.insert(word, place);
        place
    }

    /// Parameters behind `(`, up to and with its `)`. The lists that are open stand in a list, not on the stack.
    fn parameters(&mut self) -> Result<(), StepError> {
        // Places of the open lists; the parameters' own parentheses are not among them.
        let mut open: Vec<usize> = Vec::new();
        // A value is needed; just behind `(` there may be none.
        let (mut wanted, mut opened) = (true, true);
        loop {
            let token = self.token()?;
            match token {
                Token::Comma | Token::Close => {
                    if wanted && !(opened && token == Token::Close) {
                        // Some writers leave the place of a value that is not given empty.
                        self.exchange.values.push(Value::Unset);
                    }
                    wanted = token == Token::Comma;
                    opened = false;
                    if token == Token::Close {
                        let Some(list) = open.pop() else {
                            return Ok(());
                        };
                        self.close(list);
                    }
                }
                _ if !wanted => return Err(self.unexpected("`,` or `)` behind a value", token)),
                Token::Open | Token::Keyword(_) => {
                    if open.len() >= DEEPEST {
                        return Err(self.error(Problem::TooMuch {
                            what: "lists within each other",
                            limit: DEEPEST as u64,
                        }));
                    }
                    open.push(self.exchange.values.len());
                    let begun = match token {
                        Token::Open => Value::List { end: 0 },
                        _ => Value::Typed { end: 0 },
                    };
                    self.exchange.values.push(begun);
                    if token != Token::Open {
                        self.expect(Token::Open, "`(` behind the name of a type")?;
                    }
                    opened = true;
                }
                _ => {
                    let value = self.simple(token)?;
                    self.exchange.values.push(value);
                    (wanted, opened) = (false, false);
                }
            }
        }
    }

    /// Ends the list or typed value at this place.
    fn close(&mut self, list: usize) {
        let behind = self.exchange.values.len() as u32;
        if let Some(Value::List { end } | Value::Typed { end }) = self.exchange.values.get_mut(list)
        {
            *end = behind;
        }
    }

    fn simple(&self, token: Token) -> Result<Value, StepError> {
        Ok(match token {
            Token::Number(number) => Value::Number(number),
            Token::Reference(number) => Value::Reference(number),
            Token::Text(span) => Value::Text(span),
            Token::Enumeration(span) => Value::Enumeration(span),
            Token::Binary(_) => Value::Binary,
            Token::Dollar => Value::Unset,
            Token::Star => Value::Derived,
            other => return Err(self.unexpected("a value", other)),
        })
    }

    /// Sorts the entities by their numbers.
    fn finished(self) -> Result<Exchange<'t>, StepError> {
        let mut exchange = self.exchange;
        exchange
            .entities
            .sort_by_key(|entity| (entity.number, entity.line));
        for pair in exchange.entities.windows(2) {
            if let [first, second] = pair
                && first.number == second.number
            {
                let problem = Problem::Twice {
                    first_line: first.line as usize,
                };
                let line = second.line as usize;
                return Err(StepError::at(line, Some(second.number), problem));
            }
        }
        Ok(exchange)
    }
}
