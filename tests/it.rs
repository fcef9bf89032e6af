//! All integration tests as one program: each of sixty would be linked against the whole library.
//!
//! A file of this folder is a module here, its data beside it; `cargo test --test it zoo::` runs the tests of one.

#![allow(clippy::unwrap_used)] // a test may panic

mod accuracy_cli;
mod accuracy_page;
mod advice;
mod assemble_cli;
mod assembly_closed;
mod assembly_rounded;
mod assembly_starts;
mod assembly_told;
mod bench_records;
mod book;
mod branch_facts;
mod browser;
mod brute_force;
mod cad;
mod change_sets;
mod cli;
mod cli_docs;
mod clock;
mod components;
mod convert_cli;
mod depths;
mod derivatives;
mod digits;
mod digits_mixed;
mod exact_cli;
mod exact_conditions;
mod exact_rings;
mod exact_tables;
mod exact_verdict;
mod exact_ways;
mod exact_words;
mod exact_zoo;
mod explained;
mod false_predictions;
mod families;
mod format_errors;
mod format_files;
mod format_hostile;
#[path = "format_loops/main.rs"]
mod format_loops;
mod format_reading;
mod format_round_trip;
mod format_support;
mod formulations;
mod four_bars;
mod frames;
mod fuzz_format;
mod gallery;
mod gear_trains;
#[path = "germs/main.rs"]
mod germs;
mod grippers;
mod growth;
mod house;
mod html_page;
mod independence;
mod inputs;
mod inputs_alike;
mod invariance;
mod known_mechanisms;
mod log_readers;
#[path = "long_runs/main.rs"]
mod long_runs;
mod margins;
mod mechanism_table;
mod mjcf;
mod mjcf_copies;
mod mjcf_masses;
mod models;
mod near_singular;
mod other_programs;
mod play;
mod polynomial_systems;
mod pose_warnings;
mod poses;
mod read_again;
mod readme;
mod record;
mod record_files;
mod record_support;
mod robot_page;
mod rounding;
mod same_bytes;
mod scene_error;
mod sdf;
mod simulate_cli;
mod sketch_cli;
mod sketch_relations;
mod smooth_scenes;
#[path = "stability/main.rs"]
mod stability;
mod subgroups;
mod superfluous;
mod support;
mod sweep_cli;
mod thesis_rows;
mod thesis_systems;
mod trace;
mod trace_cli;
mod trace_large;
mod trace_singular;
mod true_motions;
mod unassembled;
mod variations;
mod verification;
mod work_precision;
mod world;
#[path = "writers/main.rs"]
mod writers;
mod written_otherwise;
mod zoo;
mod zoo2;
