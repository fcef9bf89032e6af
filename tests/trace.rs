#![allow(clippy::unwrap_used)]
mod support;
use kutzbach::motion::*;
use support::{analysis, in_parallel, zoo};

#[test]
fn survey() {
    let only = std::env::var("ONLY").ok();
    let zoo: Vec<_> = zoo().into_iter().filter(|(n, _)| only.as_ref().is_none_or(|o| n.contains(o.as_str()))).collect();
    let lines = in_parallel(&zoo, |(name, mechanism)| {
        let t0 = std::time::Instant::now();
        let analysis = analysis(mechanism);
        let ta = t0.elapsed();
        let mut out = String::new();
        let names: Vec<Option<String>> = match &analysis.branches { Some(b) if !b.is_empty() => b.iter().map(|b| Some(b.name.clone())).collect(), _ => vec![None] };
        for b in names {
            let t0 = std::time::Instant::now();
            let o = TraceOptions { branch: b, samples: 101, ..Default::default() };
            match std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| trace(mechanism, &analysis, &o))) {
                Err(_) => out += &format!("{name}: PANIC\n"),
                Ok(Err(e)) => out += &format!("{name}: ERR {e}\n"),
                Ok(Ok(Trace::Still(s))) => out += &format!("{name}: still {}\n", s.reason),
                Ok(Ok(Trace::Moving(m))) => {
                    let dc = m.events.iter().filter(|e| matches!(e.kind, EventKind::DeadCentre{..})).count();
                    let sg: Vec<String> = m.events.iter().filter_map(|e| match &e.kind { EventKind::Singular{freedom, excess, crosses, home} => Some(format!("[{:.3} f{freedom}+{excess}{}{}]", e.arclength, if *crosses {"x"} else {"t"}, if *home {" home"} else {""})), EventKind::Cusp{home} => Some(format!("[cusp {:.3} {home}]", e.arclength)), _ => None }).collect();
                    out += &format!("{name} {}: d{} drive {} held {:?} home {} closed {:?} ends {:?} dead {dc} sing {} samples {} closure {:.1e} nodes {} {:?} {:?} (analysis {:.0?} trace {:.0?}) {:?}\n", m.branch, m.dimension, m.driven.name, m.held.iter().map(|h| h.variable.name.clone()).collect::<Vec<_>>(), m.starts_at_home, m.closed, m.ends.iter().map(|e| format!("{:.3}@{:.3} {:?}", e.drive, e.arclength, e.reason)).collect::<Vec<_>>(), sg.join(""), m.samples.len(), m.largest_closure, 0, m.spacing, m.ranges.iter().filter(|r| r.turns != 0).count(), ta, t0.elapsed(), m.notes);
                }
            }
        }
        out
    });
    println!("{}", lines.concat());
}
