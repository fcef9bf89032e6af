use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::mobility::{analyse, AnalysisOptions};
use kutzbach::simulate::verification::*;
use std::ops::ControlFlow;
struct P(usize);
impl Observer for P { fn begin(&mut self, p:&Passage)->ControlFlow<()>{println!("{} {}",p.title,p.duration);self.0=0;ControlFlow::Continue(())}
 fn moment(&mut self, m:&Moment<'_>)->ControlFlow<()>{ self.0+=1; if self.0%10==0 {println!("t {:.2} done {:.3} err {:.1e} dist {:.1e} {:?}",m.time,m.done,m.closure_error,m.distance,m.states.iter().map(|s| s.values.iter().map(|v| (v*1e4).round()/1e4).collect::<Vec<_>>()).collect::<Vec<_>>());} ControlFlow::Continue(())}
 fn say(&mut self,_:&str){} }
fn main() {
    let file = std::env::args().nth(1).unwrap();
    let reading = kutzbach::format::read_file(std::path::Path::new(&file), &[]).unwrap();
    let m = &reading.mechanism;
    let a = analyse(m, &AnalysisOptions::default()).unwrap();
    let g = Geometry::new(m, None, &Arithmetic::double());
    println!("{:?}", m.joints().iter().map(|j| j.name.clone()).collect::<Vec<_>>());
    let o = VerificationOptions { ladder: vec![8], solvers: vec![kutzbach::simulate::Solver::Multibody], ..Default::default() };
    verify(m,&g,&a,&o,&mut P(0)).unwrap();
    let t = kutzbach::motion::trace(m,&a,&kutzbach::motion::TraceOptions{samples:30,..Default::default()}).unwrap();
    if let Some(mo) = t.motion() { println!("{:?} {:?} closed {:?} ends {:?}", mo.driven, mo.held, mo.closed, mo.ends); for e in &mo.events { println!("{:?} {} {}", e.kind, e.arclength, e.drive);} for s in &mo.samples { println!("{:.3} {:.4} {:?} {:.1e}", s.arclength, s.drive, s.values.iter().map(|v| (v*1e4).round()/1e4).collect::<Vec<_>>(), s.closure);} }
}
