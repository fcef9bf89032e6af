//! stub
use std::ops::{Add, Mul, Neg, Sub};
pub type Float = f64;
#[derive(Clone, Debug)]
pub struct Number(f64, Option<Stated>);
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stated {
    pub decimals: i32,
    pub significant: u32,
}
#[derive(Clone, Debug, thiserror::Error)]
#[error("{message}")]
pub struct NumberError {
    pub offset: usize,
    pub message: String,
}
impl Number {
    pub fn zero() -> Self {
        Number(0.0, None)
    }
    pub fn one() -> Self {
        Number(1.0, None)
    }
    pub fn integer(i: i64) -> Self {
        Number(i as f64, None)
    }
    pub fn ratio(a: i64, b: i64) -> Option<Self> {
        Some(Number(a as f64 / b as f64, None))
    }
    pub fn from_f64(x: f64) -> Option<Self> {
        x.is_finite().then_some(Number(x, None))
    }
    pub fn decimal(t: &str) -> Result<Self, NumberError> {
        t.parse().map(|x| Number(x, None)).map_err(|_| NumberError {
            offset: 0,
            message: "x".into(),
        })
    }
    pub fn expression(
        _t: &str,
        _l: &mut dyn FnMut(&str) -> Result<Option<Number>, String>,
    ) -> Result<Self, NumberError> {
        Ok(Number(0.0, None))
    }
    pub fn value(&self) -> f64 {
        self.0
    }
    pub fn evaluate(&self, _b: usize) -> Float {
        self.0
    }
    pub fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
    pub fn stated(&self) -> Option<Stated> {
        self.1
    }
    pub fn source(&self) -> String {
        self.0.to_string()
    }
}
impl PartialEq for Number {
    fn eq(&self, o: &Self) -> bool {
        self.0 == o.0
    }
}
impl Add for &Number {
    type Output = Number;
    fn add(self, o: &Number) -> Number {
        Number(self.0 + o.0, None)
    }
}
impl Sub for &Number {
    type Output = Number;
    fn sub(self, o: &Number) -> Number {
        Number(self.0 - o.0, None)
    }
}
impl Mul for &Number {
    type Output = Number;
    fn mul(self, o: &Number) -> Number {
        Number(self.0 * o.0, None)
    }
}
impl Neg for &Number {
    type Output = Number;
    fn neg(self) -> Number {
        Number(-self.0, None)
    }
}
