//! The order in which names are listed.

use std::cmp::Ordering;

/// Compares names the way a person sorts them: runs of digits by value, so that `J2` comes before `J10`.
///
/// A total order: names that differ only in leading zeros are told apart by plain comparison, so that equal means
/// identical. Linear in the length of the names; runs of digits may be of any length.
#[must_use]
pub fn natural_order(a: &str, b: &str) -> Ordering {
    let (mut left, mut right) = (a, b);
    loop {
        let (Some(x), Some(y)) = (left.chars().next(), right.chars().next()) else {
            return left.len().cmp(&right.len()).then_with(|| a.cmp(b));
        };
        if x.is_ascii_digit() && y.is_ascii_digit() {
            let (run_x, rest_x) = split_digits(left);
            let (run_y, rest_y) = split_digits(right);
            let (value_x, value_y) = (run_x.trim_start_matches('0'), run_y.trim_start_matches('0'));
            let order = value_x
                .len()
                .cmp(&value_y.len())
                .then_with(|| value_x.cmp(value_y));
            if order != Ordering::Equal {
                return order;
            }
            (left, right) = (rest_x, rest_y);
        } else {
            if x != y {
                return x.cmp(&y);
            }
            (left, right) = (&left[x.len_utf8()..], &right[y.len_utf8()..]);
        }
    }
}

fn split_digits(text: &str) -> (&str, &str) {
    let end = text
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(text.len());
    text.split_at(end)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn digits_count_by_value() {
        let mut names = ["J10", "J2", "j1", "J", "J02", "J2.rot", "J1a", "Jä"];
        names.sort_by(|a, b| natural_order(a, b));
        assert_eq!(
            names,
            ["J", "J1a", "J02", "J2", "J2.rot", "J10", "Jä", "j1"]
        );
    }

    proptest! {
        #[test]
        fn is_a_total_order(a in "[a0-9]{0,4}", b in "[a0-9]{0,4}", c in "[a0-9]{0,4}") {
            prop_assert_eq!(natural_order(&a, &b), natural_order(&b, &a).reverse());
            prop_assert_eq!(natural_order(&a, &b) == Ordering::Equal, a == b);
            if natural_order(&a, &b).is_le() && natural_order(&b, &c).is_le() {
                prop_assert!(natural_order(&a, &c).is_le());
            }
        }
    }
}
