//! Pareto front.

/// For every (cost, error), whether no other has both no greater and one of them less: the Pareto front (Pareto 1906;
/// the word for it is later). What has no cost or error, or one that is no number, is not on it; of equals the first is.
#[must_use]
pub fn pareto_front(points: &[Option<(f64, f64)>]) -> Vec<bool> {
    let known = |point: &Option<(f64, f64)>| point.filter(|(c, e)| c.is_finite() && e.is_finite());
    let beats = |(i, a): (usize, (f64, f64)), (j, b): (usize, (f64, f64))| {
        a.0 <= b.0 && a.1 <= b.1 && (a.0 < b.0 || a.1 < b.1 || i < j)
    };
    let all: Vec<(usize, (f64, f64))> = points
        .iter()
        .enumerate()
        .filter_map(|(i, p)| Some((i, known(p)?)))
        .collect();
    points
        .iter()
        .enumerate()
        .map(|(i, point)| {
            known(point).is_some_and(|here| {
                !all.iter()
                    .any(|other| other.0 != i && beats(*other, (i, here)))
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_slower_and_worse_is_not_on_the_front() {
        let points = [
            Some((1.0, 1e-3)),
            Some((2.0, 1e-3)),
            Some((2.0, 1e-5)),
            Some((1.5, 1e-4)),
            Some((9.0, f64::NAN)),
            None,
            Some((2.0, 1e-5)),
        ];
        let front = pareto_front(&points);
        assert_eq!(front, [true, false, true, true, false, false, false]);
    }

    #[test]
    fn along_the_front_what_costs_more_errs_less() {
        // A grid of pseudo-random points.
        let points: Vec<Option<(f64, f64)>> = (0..200u32)
            .map(|i| Some((f64::from(i * 37 % 101), f64::from(i * 53 % 97))))
            .collect();
        let front = pareto_front(&points);
        let mut kept: Vec<(f64, f64)> = points
            .iter()
            .zip(&front)
            .filter_map(|(p, on)| p.filter(|_| *on))
            .collect();
        assert!(!kept.is_empty());
        kept.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert!(kept.windows(2).all(|p| p[0].0 < p[1].0 && p[0].1 > p[1].1));
    }
}
