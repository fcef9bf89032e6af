//! Idle and useful freedoms of robots, and what inputs do: mechanisms whose answers can be counted by hand.

use kutzbach::format::read;
use kutzbach::report::text::Layout;
use kutzbach::report::{InputSource, Inputs, Options, Report, report};

fn reported_with(text: &str, inputs: &[&str]) -> Report {
    let reading = read(text, "file.urdf", &[]).unwrap_or_else(|error| panic!("{error}"));
    let options = Options {
        inputs: inputs.iter().map(|&name| name.to_owned()).collect(),
        ..Options::default()
    };
    report(&reading, "file.urdf", &options).unwrap()
}

fn reported(text: &str) -> Report {
    reported_with(text, &[])
}

fn shares(report: &Report) -> (usize, usize) {
    let freedoms = report.freedoms.as_ref().unwrap();
    (freedoms.useful, freedoms.idle)
}

/// Names of the links that idle entries are called by.
fn idle(report: &Report) -> Vec<(String, usize)> {
    report.branches.as_ref().unwrap()[0]
        .idle
        .iter()
        .map(|idle| (idle.links[0].clone(), idle.freedom))
        .collect()
}

/// A joint of the tree.
fn joint(name: &str, kind: &str, parent: &str, child: &str, at: &str, axis: &str) -> String {
    format!(
        r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="{at}"/><axis xyz="{axis}"/></joint>"#
    )
}

/// A ball as three hinges with two links between.
fn ball(name: &str, parent: &str, child: &str, at: &str) -> String {
    let (one, two) = (format!("{name}_1"), format!("{name}_2"));
    format!(r#"<link name="{one}"/><link name="{two}"/>"#)
        + &joint(
            &format!("{name}_x"),
            "continuous",
            parent,
            &one,
            at,
            "1 0 0",
        )
        + &joint(
            &format!("{name}_y"),
            "continuous",
            &one,
            &two,
            "0 0 0",
            "0 1 0",
        )
        + &joint(
            &format!("{name}_z"),
            "continuous",
            &two,
            child,
            "0 0 0",
            "0 0 1",
        )
}

fn links(names: &[&str]) -> String {
    names
        .iter()
        .map(|name| format!(r#"<link name="{name}"/>"#))
        .collect()
}

/// The linkage of two cranks on skew shafts and a rod, as the file of a robot writes it: the rod of two links, a ball of three
/// hinges at one end, the other end closed by `end` at a frame that is fixed to the rod.
fn rssr(end: &str) -> String {
    format!(
        r#"<robot name="rssr">{}{}{}{}{}{end}</robot>"#,
        links(&["base", "crank", "rod", "tip", "rocker"]),
        joint("crank_pivot", "revolute", "base", "crank", "0 0 0", "0 0 1"),
        joint(
            "rocker_pivot",
            "revolute",
            "base",
            "rocker",
            "2 3 0",
            "1 2 2"
        ),
        ball("crank_ball", "crank", "rod", "1 0 0"),
        joint("tip_frame", "fixed", "rod", "tip", "1 3 2", "1 0 0"),
    )
}

const BALL_END: &str = r#"<loop name="end" type="spherical"><predecessor link="tip"/><successor link="rocker"><origin xyz="0 0 2"/></successor></loop>"#;

#[test]
fn a_rod_between_balls_of_hinges_spins() {
    let three_hinges = ball("rocker_ball", "rocker", "rocker_cup", "0 0 2")
        + r#"<link name="rocker_cup"/><loop name="end" type="fixed"><predecessor link="tip"/><successor link="rocker_cup"/></loop>"#;
    for end in [BALL_END, &three_hinges] {
        let report = reported(&rssr(end));
        assert_eq!(report.mobility.finite, Some(2));
        assert_eq!(shares(&report), (1, 1), "{end}");
        assert!(report.freedoms.as_ref().unwrap().rods);
        let idle = &report.branches.as_ref().unwrap()[0].idle;
        assert_eq!(idle.len(), 1);
        // What moves: the rod with its tip, and what the hinges put between.
        for link in ["rod", "tip", "crank_ball_1", "crank_ball_2"] {
            assert!(
                idle[0].links.iter().any(|moved| moved == link),
                "{:?}",
                idle[0]
            );
        }
        assert!(
            !idle[0]
                .links
                .iter()
                .any(|moved| moved == "rocker" || moved == "crank")
        );
    }
}

#[test]
fn bodies_are_called_by_no_frame() {
    let report = reported(&rssr(BALL_END).replace("\"tip\"", "\"a_frame\""));
    assert_eq!(idle(&report), [("rod".to_owned(), 1)]);
}

#[test]
fn a_rod_that_carries_a_tool_by_a_joint_is_not_idle() {
    let tool = r#"<link name="tool"/><joint name="wrist" type="revolute"><parent link="rod"/><child link="tool"/></joint>"#;
    let report = reported(&rssr(&(BALL_END.to_owned() + tool)));
    assert_eq!((report.mobility.finite, shares(&report)), (Some(3), (3, 0)));
}

#[test]
fn a_universal_joint_at_one_end_stops_the_spin() {
    let text = format!(
        r#"<robot name="rsur">{}{}{}{}{}{BALL_END}</robot>"#,
        links(&["base", "crank", "cross", "rod", "tip", "rocker"]),
        joint("crank_pivot", "revolute", "base", "crank", "0 0 0", "0 0 1")
            + &joint(
                "rocker_pivot",
                "revolute",
                "base",
                "rocker",
                "2 3 0",
                "1 2 2"
            ),
        joint("u_x", "revolute", "crank", "cross", "1 0 0", "1 0 0"),
        joint("u_y", "revolute", "cross", "rod", "0 0 0", "0 1 0"),
        joint("tip_frame", "fixed", "rod", "tip", "1 3 2", "1 0 0"),
    );
    assert_eq!(shares(&reported(&text)), (1, 0));
}

/// A platform on three telescopic legs of two bodies each, with a ball at the platform, and a ball of three hinges, or a hinge, at
/// the base.
fn tripod(ball_at_base: bool) -> String {
    let mut text = links(&["base", "platform"]);
    let feet = ["2 0 0", "-1 1.7 0.1", "-1 -1.8 -0.1"];
    let tops = ["1 0.2 2", "-0.6 0.8 2.1", "-0.4 -0.9 1.9"];
    for (index, (foot, top)) in feet.iter().zip(tops).enumerate() {
        let (barrel, rod) = (format!("barrel_{index}"), format!("rod_{index}"));
        let numbers =
            |text: &str| -> Vec<f64> { text.split(' ').map(|x| x.parse().unwrap()).collect() };
        let (foot_at, top_at) = (numbers(foot), numbers(top));
        let along: Vec<String> = foot_at
            .iter()
            .zip(&top_at)
            .map(|(a, b)| format!("{}", b - a))
            .collect();
        let along = along.join(" ");
        text += &links(&[&barrel, &rod]);
        text += &if ball_at_base {
            ball(&format!("foot_{index}"), "base", &barrel, foot)
        } else {
            joint(
                &format!("foot_{index}"),
                "revolute",
                "base",
                &barrel,
                foot,
                "0.3 1 0.2",
            )
        };
        text += &joint(
            &format!("slide_{index}"),
            "prismatic",
            &barrel,
            &rod,
            "0 0 0",
            &along,
        );
        if index == 0 {
            text += &ball("top_0", &rod, "platform_frame", &along);
            text += r#"<link name="platform_frame"/>"#;
            text += &format!(
                r#"<joint name="up" type="fixed"><parent link="platform_frame"/><child link="platform"/><origin xyz="{}"/></joint>"#,
                top_at
                    .iter()
                    .map(|x| format!("{}", -x))
                    .collect::<Vec<_>>()
                    .join(" ")
            );
        } else {
            text += &format!(
                r#"<loop name="top_{index}" type="spherical"><predecessor link="{rod}"><origin xyz="{along}"/></predecessor>
                <successor link="platform"><origin xyz="{top}"/></successor></loop>"#
            );
        }
    }
    format!(r#"<robot name="tripod">{text}</robot>"#)
}

#[test]
fn telescopic_legs_between_balls_spin_as_a_whole() {
    // Seven bodies with 6 freedoms each, less 3 × (3 + 5 + 3) equations: 9, of which three legs spin.
    let report = reported(&tripod(true));
    assert_eq!(report.mobility.finite, Some(9));
    assert_eq!(shares(&report), (6, 3));
    let names: Vec<String> = idle(&report).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["barrel_0", "barrel_1", "barrel_2"]);
    assert!(report.freedoms.unwrap().rods);
    // On hinges nothing spins.
    assert_eq!(shares(&reported(&tripod(false))), (3, 0));
}

fn inputs(report: &Report) -> &Inputs {
    report.inputs.as_ref().unwrap()
}

#[test]
fn idle_freedoms_are_no_missing_inputs() {
    let report = reported(&tripod(true));
    let found = inputs(&report);
    assert!(found.given.is_empty() && found.source.is_none());
    // Three sliders, and of each leg all turns of a ball: to hold its swing is to hold its spin.
    assert_eq!((found.left, found.complete), (Some(6), true));
    assert_eq!(found.proposed[..3], ["slide_0", "slide_1", "slide_2"]);
    assert!(found.proposed.len() <= 9, "{:?}", found.proposed);
    let report = reported_with(&rssr(BALL_END), &["crank_pivot"]);
    let found = inputs(&report);
    assert_eq!((found.independent, found.left), (Some(1), Some(0)));
    assert_eq!(found.source, Some(InputSource::Asked));
    let of = |name: &str| {
        found
            .followers
            .iter()
            .find(|f| f.joint == name)
            .unwrap()
            .of
            .clone()
    };
    assert_eq!(of("rocker_pivot"), Some(vec!["crank_pivot".to_owned()]));
    assert_eq!(of("crank_ball_z"), None, "the spin moves it too");
}

/// A planar five-bar with one hinge driven twice over by a belt, and a free arm beside it.
fn five_bar(extra: &str) -> String {
    format!(
        r#"<robot name="five">{}{}{}{}{}{}
        <loop name="e" type="revolute"><predecessor link="l2"><origin xyz="1 0 0"/></predecessor>
        <successor link="r2"><origin xyz="0 1 0"/></successor><axis xyz="0 0 1"/></loop>{extra}</robot>"#,
        links(&["base", "l1", "l2", "r1", "r2", "arm"]),
        joint("a", "revolute", "base", "l1", "0 0 0", "0 0 1"),
        joint("b", "revolute", "l1", "l2", "0 1.3 0", "0 0 1"),
        joint("c", "revolute", "base", "r1", "1.5 0 0", "0 0 1"),
        joint("d", "revolute", "r1", "r2", "-0.5 0.3 0", "0 0 1"),
        joint("w", "revolute", "base", "arm", "0 0 1", "1 0 0"),
    )
}

#[test]
fn inputs_are_enough_dependent_or_missing() {
    for (given, independent, left) in [
        (vec!["a", "c", "w"], 3, 0),
        (vec!["a", "c"], 2, 1),
        (vec!["a", "b", "c"], 2, 1),
        (vec!["w"], 1, 2),
        (vec!["a", "b", "c", "d", "e", "w"], 3, 0),
    ] {
        let report = reported_with(&five_bar(""), &given);
        let found = inputs(&report);
        assert_eq!(found.independent, Some(independent), "{given:?}");
        assert_eq!(found.left, Some(left), "{given:?}");
        assert_eq!(found.proposed.len(), left, "{given:?}");
        assert_eq!(
            found.dependent.len(),
            given.len() - independent,
            "{given:?}"
        );
    }
    // In a chain of two freedoms any further hinge follows from both.
    let report = reported_with(&five_bar(""), &["a", "c", "d"]);
    let dependent = &inputs(&report).dependent[0];
    assert_eq!(
        (dependent.input.as_str(), dependent.on.as_deref().unwrap()),
        ("d", &["a".to_owned(), "c".to_owned()][..])
    );
    let followers = &inputs(&report).followers;
    let of = |name: &str| {
        followers
            .iter()
            .find(|f| f.joint == name)
            .unwrap()
            .of
            .clone()
            .unwrap()
    };
    assert_eq!(of("b"), ["a", "c"]);
}

#[test]
fn a_coupled_motor_depends_on_its_partner_only() {
    let belt = r#"<link name="pulley"/><joint name="p" type="revolute"><parent link="base"/><child link="pulley"/><axis xyz="0 0 1"/>
        <mimic joint="a" multiplier="-2"/></joint>"#;
    let report = reported_with(&five_bar(belt), &["a", "c", "p", "w"]);
    let found = inputs(&report);
    assert_eq!((found.independent, found.left), (Some(3), Some(0)));
    assert_eq!(found.dependent[0].on.as_deref().unwrap(), ["a"]);
}

#[test]
fn files_name_their_inputs() {
    let motors = r#"<transmission name="t"><joint name="a"/></transmission><transmission name="u"><joint name="c"/></transmission>"#;
    let report = reported(&five_bar(motors));
    let found = inputs(&report);
    assert_eq!(
        (found.source, found.left),
        (Some(InputSource::File), Some(1))
    );
    assert_eq!(found.given, ["a", "c"]);
    assert_eq!(found.proposed, ["w"]);
    let marked = five_bar("")
        .replace(r#"name="b" type"#, r#"name="b" independent="false" type"#)
        .replace(r#"name="d" type"#, r#"name="d" independent="false" type"#);
    let report = reported(&marked);
    let found = inputs(&report);
    assert_eq!(
        (found.source, found.left),
        (Some(InputSource::Independent), Some(0))
    );
    assert_eq!(found.given, ["a", "c", "w"]);
}

#[test]
fn names_that_are_no_inputs_are_refused() {
    let reading = read(&five_bar(""), "file.urdf", &[]).unwrap();
    let options = |name: &str| Options {
        inputs: vec![name.to_owned()],
        ..Options::default()
    };
    let error = report(&reading, "file.urdf", &options("z9")).unwrap_err();
    assert!(error.to_string().contains("`z9`"));
    let reading = read(&rssr(BALL_END), "file.urdf", &[]).unwrap();
    let error = report(&reading, "file.urdf", &options("crank_pivto")).unwrap_err();
    assert!(error.help().contains("crank_pivot"), "{}", error.help());
    let error = report(&reading, "file.urdf", &options("tip_frame")).unwrap_err();
    assert!(error.to_string().contains("no freedom"));
}

/// Two legs of three hinges on a torso, which a waist joins to the base.
#[test]
fn limbs_have_their_own_freedoms() {
    let mut text =
        links(&["base", "torso"]) + &joint("waist", "revolute", "base", "torso", "0 0 1", "0 0 1");
    for side in ["left", "right"] {
        let name = |part: &str| format!("{side}_{part}");
        text += &links(&[&name("thigh"), &name("shin"), &name("foot")]);
        text += &joint(
            &name("hip"),
            "revolute",
            "torso",
            &name("thigh"),
            "0 0.1 0",
            "0 1 0",
        );
        text += &joint(
            &name("knee"),
            "revolute",
            &name("thigh"),
            &name("shin"),
            "0 0 -1",
            "0 1 0",
        );
        text += &joint(
            &name("ankle"),
            "revolute",
            &name("shin"),
            &name("foot"),
            "0 0 -1",
            "0 1 0",
        );
    }
    let tie = r#"<coupling name="c"><predecessor link="left_thigh"/><successor link="left_shin"/><ratio value="0"/></coupling>"#;
    let report = reported(&format!(r#"<robot name="biped">{text}{tie}</robot>"#));
    let found = inputs(&report);
    assert_eq!(
        (found.base.as_deref(), found.trunk),
        (Some("torso"), Some(1))
    );
    let limbs: Vec<(&str, usize)> = found
        .limbs
        .iter()
        .map(|limb| (limb.end.as_str(), limb.freedom))
        .collect();
    assert_eq!(limbs, [("left_foot", 2), ("right_foot", 3)]);
}

/// A rod between two balls whose spin moves a flywheel by a hair: the ball at the crank is missed by its first axis by a tenth of a
/// millimetre, so that nothing is idle, and nobody would call the spin useful.
#[test]
fn a_spin_that_hardly_moves_anything_is_nearly_idle() {
    let cup = r#"<link name="cup"/>"#.to_owned()
        + &joint(
            "cup_axis",
            "revolute",
            "rocker",
            "cup",
            "0 0 2",
            "1 0.3 0.2",
        )
        + r#"<loop name="end" type="spherical"><predecessor link="tip"/><successor link="cup"><origin xyz="0 ${1/10000} 0"/></successor></loop>"#;
    let report = reported(&rssr(&cup));
    assert_eq!(report.mobility.finite, Some(3));
    let branch = &report.branches.as_ref().unwrap()[0];
    assert_eq!(branch.idle.len(), 1, "the rod itself spins");
    assert!(
        branch.nearly_idle.iter().any(|idle| idle.links[0] == "cup"),
        "{:?}",
        branch.nearly_idle
    );
    assert_eq!(shares(&report), (2, 1));
}

/// A report with some inputs, as one line.
fn told(text: &str, inputs: &[&str]) -> String {
    let report = reported_with(text, inputs);
    let text = kutzbach::report::text::render(&report, Layout::default());
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn idle_freedoms_that_inputs_hold_are_not_left() {
    let text = include_str!("../mechanisms/rssr.urdf");
    assert!(told(text, &["crank_pivot"]).contains("(1), with 1 idle left."));
    let both = told(text, &["crank_pivot", "crank_ball.rot2"]);
    assert!(both.contains("sufficient for all 2 degrees of freedom, the idle ones included."));
}

#[test]
fn frames_that_are_fixed_to_one_link_are_one_neighbour() {
    let door = format!(
        r#"<robot name="door">{}{}{}{}<loop name="upper" type="revolute"><predecessor link="above"/><successor link="door"><origin xyz="0 0 2"/></successor><axis xyz="0 0 1"/></loop></robot>"#,
        links(&["wall", "above", "below", "door"]),
        joint("f1", "fixed", "wall", "below", "0 0 0", "1 0 0"),
        joint("f2", "fixed", "wall", "above", "0 0 2", "1 0 0"),
        joint("lower", "continuous", "below", "door", "0 0 0", "0 0 1"),
    );
    let report = reported(&door);
    assert_eq!(shares(&report), (1, 0));
    assert!(idle(&report).is_empty());
}

#[test]
fn joints_that_are_marked_as_dependent_are_not_proposed() {
    // A parallelogram of four hinges, any one of which could drive it; no joint is left to be called independent but the last.
    let hinge = |name: &str, parent: &str, child: &str, at: &str, marked: &str| {
        joint(name, "continuous", parent, child, at, "0 0 1").replacen(
            "type=",
            &format!("independent=\"{marked}\" type="),
            1,
        )
    };
    let text = |last: &str| {
        format!(
            r#"<robot name="r">{}{}{}{}<loop name="l" type="revolute"><predecessor link="b"><origin xyz="2 0 0"/></predecessor><successor link="c"><origin xyz="0 1 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#,
            links(&["base", "a", "b", "c"]),
            hinge("j1", "base", "a", "0 0 0", "false"),
            hinge("j2", "a", "b", "0 1 0", "false"),
            hinge("j3", "base", "c", "2 0 0", last),
        )
    };
    let given = reported(&text("true")).inputs.unwrap();
    assert_eq!(
        (given.given, given.source),
        (vec!["j3".to_owned()], Some(InputSource::Independent))
    );
    // Where nothing is marked independent, the loop's own joint is all that may be proposed.
    let proposed = reported(&text("false")).inputs.unwrap();
    assert_eq!(proposed.proposed, ["l"]);
}

/// A torso on a post that turns, with two arms of three hinges and a neck of two, beside a wheel.
#[test]
fn a_limb_that_branches_is_named_by_its_start() {
    let mut text = links(&["base", "wheel", "torso"])
        + &joint("axle", "continuous", "base", "wheel", "1 0 0", "0 1 0")
        + &joint("waist", "continuous", "base", "torso", "0 0 1", "0 0 1");
    let mut chain = |name: &str, axes: &[&str]| {
        let mut parent = "torso".to_owned();
        for (index, axis) in axes.iter().enumerate() {
            let link = format!("{name}_{index}");
            text += &links(&[&link]);
            text += &joint(
                &format!("to_{link}"),
                "continuous",
                &parent,
                &link,
                "0.3 0.2 0.1",
                axis,
            );
            parent = link;
        }
    };
    chain("left_arm", &["1 0 0", "0 1 0", "0 1 0"]);
    chain("right_arm", &["1 0 0", "0 1 0", "0 1 0"]);
    chain("neck", &["0 1 0", "1 0 0"]);
    let tie = r#"<coupling name="c"><predecessor link="left_arm_0"/><successor link="left_arm_1"/><ratio value="0"/></coupling>"#;
    let report = reported(&format!(r#"<robot name="r">{text}{tie}</robot>"#));
    let found: Vec<(&str, usize, bool)> = inputs(&report)
        .limbs
        .iter()
        .map(|limb| (limb.end.as_str(), limb.freedom, limb.branches))
        .collect();
    assert_eq!(found, [("torso", 8, true), ("wheel", 1, false)]);
    let page = kutzbach::report::text::render(&report, Layout::default());
    assert!(page.contains("`torso` and its branches 8"), "{page}");
}

/// ```text
/// B ----- C ----- D    rods of 2, in one line
/// |               |
/// A               E    cranks of 2, 4 apart
/// ```
///
/// The rods are as long as they can be together, so that both cranks turn at the same rate: A and E are one input here.
fn stretched_five_bar(mark: &str) -> String {
    format!(
        r#"<robot name="five_bar"><link name="ground"/><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
        <joint name="A" type="continuous"><parent link="ground"/><child link="a"/><axis xyz="0 0 1"/></joint>
        <joint name="B" type="continuous" {mark}><parent link="a"/><child link="b"/><origin xyz="0 2 0"/><axis xyz="0 0 1"/></joint>
        <joint name="E" type="continuous"><parent link="ground"/><child link="d"/><origin xyz="4 0 0"/><axis xyz="0 0 1"/></joint>
        <joint name="D" type="continuous" {mark}><parent link="d"/><child link="c"/><origin xyz="0 2 0"/><axis xyz="0 0 1"/></joint>
        <loop name="C" type="continuous" {mark}><predecessor link="b"><origin xyz="2 0 0"/></predecessor>
            <successor link="c"><origin xyz="-2 0 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#
    )
}

#[test]
fn inputs_are_proposed_that_do_their_work_at_the_pose_itself() {
    const DEAD_CENTRE: &str = "act independently; locked, they leave an infinitesimal motion.";
    let five_bar = stretched_five_bar("");
    let (report, text) = (reported(&five_bar), told(&five_bar, &[]));
    let found = inputs(&report);
    assert!(found.complete && found.proposed.len() == 2, "{found:?}");
    assert_ne!(found.proposed, ["A", "E"]);
    assert_eq!(found.together_here, Some(2));
    assert!(!text.contains(DEAD_CENTRE), "{text}");
    // Both cranks are asked for, or the file leaves no other choice.
    let cranks = ["A", "E"];
    let (report, text) = (reported_with(&five_bar, &cranks), told(&five_bar, &cranks));
    assert_eq!(inputs(&report).independent_here, Some(1));
    let said = format!("only 1 {DEAD_CENTRE}");
    assert_eq!(text.matches(&said).count(), 1, "{text}");
    let marked = stretched_five_bar(r#"independent="false""#);
    let (report, text) = (reported_with(&marked, &["A"]), told(&marked, &["A"]));
    let found = inputs(&report);
    assert_eq!(
        (&found.proposed[..], found.together_here),
        (&["E".to_owned()][..], Some(1))
    );
    let said = format!("only 1 of them all {DEAD_CENTRE}");
    assert_eq!(text.matches(&said).count(), 1, "{text}");
}

/// ```text
///   rail_a == drawer == rail_b
///    |  |               |  |     two hinges side by side hold each rail to the wall
///   ========= wall =========
/// ```
#[test]
fn what_slides_between_rails_on_one_wall_is_useful() {
    let hinge = |name: &str, rail: &str, at: &str| {
        format!(
            r#"<loop name="{name}" type="revolute"><predecessor link="wall"><origin xyz="{at}"/></predecessor>
            <successor link="{rail}"><origin xyz="0 1 0"/></successor><axis xyz="0 0 1"/></loop>"#
        )
    };
    let mut text = links(&["wall", "rail_a", "rail_b", "drawer"]);
    text += &joint("a1", "revolute", "wall", "rail_a", "0 0 0", "0 0 1");
    text += &hinge("a2", "rail_a", "0 1 0");
    text += &joint("b1", "revolute", "wall", "rail_b", "1 0 0", "0 0 1");
    text += &hinge("b2", "rail_b", "1 1 0");
    text += &joint("s1", "prismatic", "rail_a", "drawer", "0 0 0", "0 1 0");
    let slide = r#"<loop name="s2" type="prismatic"><predecessor link="rail_b"/>
        <successor link="drawer"><origin xyz="1 0 0"/></successor><axis xyz="0 1 0"/></loop>"#;
    let report = reported(&format!(r#"<robot name="drawer">{text}{slide}</robot>"#));
    assert_eq!(report.mobility.finite, Some(1));
    assert_eq!(shares(&report), (1, 0));
    assert_eq!(inputs(&report).proposed, ["s1"]);
    // A rod between balls on the two rails spins, and is of no use.
    let rod = ball("left", "rail_a", "rod", "0 0 1");
    let right = r#"<link name="rod"/><loop name="right" type="spherical"><predecessor link="rod"><origin xyz="1 0 0"/></predecessor>
        <successor link="rail_b"><origin xyz="0 0 1"/></successor></loop>"#;
    let report = reported(&format!(
        r#"<robot name="drawer">{text}{slide}{rod}{right}</robot>"#
    ));
    assert_eq!(report.mobility.finite, Some(2));
    assert_eq!(shares(&report), (1, 1));
    assert_eq!(idle(&report), [("rod".to_owned(), 1)]);
}

#[test]
fn proofs_do_not_name_frames() {
    let parallelogram = |frames: bool| {
        let [left, right] = if frames {
            ["left", "right"]
        } else {
            ["wall"; 2]
        };
        let fixed = |name: &str| {
            let joint = joint(
                &format!("{name}_frame"),
                "fixed",
                "wall",
                name,
                "0 0 0",
                "1 0 0",
            );
            format!("{}{joint}", links(&[name]))
        };
        let frames = match frames {
            true => fixed("left") + &fixed("right"),
            false => String::new(),
        };
        let text = format!(
            r#"{}{frames}{}{}{}<loop name="D" type="revolute"><predecessor link="b"><origin xyz="3 0 0"/></predecessor>
            <successor link="c"><origin xyz="0 1 0"/></successor><axis xyz="0 0 1"/></loop>"#,
            links(&["wall", "a", "b", "c"]),
            joint("A", "revolute", left, "a", "0 0 0", "0 0 1"),
            joint("B", "revolute", "a", "b", "0 1 0", "0 0 1"),
            joint("C", "revolute", right, "c", "3 0 0", "0 0 1"),
        );
        let report = reported(&format!(r#"<robot name="parallelogram">{text}</robot>"#));
        report.mobility.certificate.unwrap().text
    };
    let text = parallelogram(true);
    assert!(text.contains("`A`") && !text.contains("frame"), "{text}");
    assert_eq!(text, parallelogram(false));
}
