use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::mobility::{analyse, AnalysisOptions};
use kutzbach::simulate::Solver; use kutzbach::simulate::verification::*;
fn main() {
    let whole = std::env::var("WHOLE").is_ok();
    for file in std::env::args().skip(1) {
        let reading = kutzbach::format::read_file(std::path::Path::new(&file), &[]).unwrap();
        let m = &reading.mechanism;
        let a = analyse(m, &AnalysisOptions::default()).unwrap();
        let g = Geometry::new(m, None, &Arithmetic::double());
        let mut o = VerificationOptions { whole_ladder: whole, ..Default::default() };
        if let Ok(l) = std::env::var("LADDER") { o.ladder = l.split(',').map(|x| x.parse().unwrap()).collect(); }
        if let Ok(l) = std::env::var("DT") { o.time_step = 1.0/l.parse::<f64>().unwrap(); }
        if std::env::var("IMPULSE").is_ok() { o.solvers = vec![Solver::Impulse]; }
        let t = std::time::Instant::now();
        let short = file.rsplit('/').next().unwrap();
        match verify(m, &g, &a, &o, &mut Unobserved) {
            Err(e) => println!("{short}: ERROR {e}"),
            Ok(v) => {
                println!("{short}: {:?} {:?} {} [{:.2} s]", v.verdict, v.finding.outcome, v.finding.why, t.elapsed().as_secs_f64());
                if std::env::var("QUIET").is_ok() { continue; }
                for b in &v.branches {
                    println!("  {} dim {} {:?} {}", b.branch, b.dimension, b.finding.outcome, b.finding.why);
                    for l in &b.ladders { println!("   {:?} driven {} {:.3}..{:.3} ({}) held {:?}: {:?} {}", l.solver, l.driven, l.from, l.to, l.ends, l.held, l.finding.outcome, l.finding.why);
                    for r in &l.rungs { println!("    {:5} err {:.2e} dist {:.2e} progress {:.2} order {:?} {:.3}s", r.substeps, r.closure_error, r.distance, r.progress, r.order.map(|x| (x*100.0).round()/100.0), r.wall_time); } }
                    if let Some(c) = &b.freedoms { println!("    freedoms {} of {} gap {:.1e} {:?} {:?}", c.found, c.expected, c.gap, c.finding.outcome, c.singular_values.iter().map(|x| format!("{x:.1e}")).collect::<Vec<_>>()); }
                }
                if let Some(p) = &v.pushing { for r in &p.rungs { println!("    {:5} moved {:.2e} at {} err {:.2e} pushes {} {:.3}s", r.substeps, r.moved, r.farthest, r.closure_error, r.pushes, r.wall_time); } }
                
            }
        }
    }
}
