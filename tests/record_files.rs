//! What is left when writing a log ends early: nothing, or something readable.

use crate::record_support;
use crate::support;

use foxglove::messages::Log;
use kutzbach::record::{LogFile, Motion, RecordError, Recorder};
use record_support::{Subject, bytes, messages, on_topic, record};
use std::io::{self, Write};
use std::path::PathBuf;
use support::{empty_folder, zoo_mechanism};

#[test]
fn an_empty_recording_is_a_log() {
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let log = bytes(&subject, 0);
    let (found, fault) = messages(&log);
    assert!(!fault);
    assert_eq!(found.len(), 1, "the log's own entry");
    let recorder = subject.recorder(Vec::new()).unwrap();
    let (summary, log) = recorder.finish_into().unwrap();
    assert_eq!((summary.moments, summary.messages), (0, 0));
    let read = mcap::Summary::read(&log).unwrap().unwrap();
    assert_eq!(read.stats.unwrap().message_count, 0);
    assert_eq!(read.attachment_indexes.len(), 2);
}

#[test]
fn a_log_cut_anywhere_is_readable_up_to_the_cut() {
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let log = bytes(&subject, 200);
    let (whole, _) = messages(&log);
    let mut last = 0;
    let step = log.len() / 211;
    for cut in (0..log.len()).step_by(step) {
        let (found, _) = messages(&log[..cut]);
        assert!(found.len() >= last, "more bytes, fewer messages");
        last = found.len();
        assert_eq!(found, whole[..last]);
        // No more than one chunk of 32 moments, 7 messages each, and the summary is lost.
        let bytes_per_moment = log.len() / 200;
        let kept = cut.saturating_sub(34 * bytes_per_moment) / bytes_per_moment;
        let data_ends = 200 - 32;
        assert!(
            found.len() >= 7 * kept.min(data_ends).saturating_sub(32),
            "{cut} of {}: {} messages",
            log.len(),
            found.len()
        );
    }
    assert!(last * 10 > whole.len() * 9);
}

/// Takes some bytes and then no more.
struct Full {
    room: usize,
    taken: Vec<u8>,
}

impl Write for &mut Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.room == 0 {
            return Err(io::Error::from(io::ErrorKind::StorageFull));
        }
        let count = bytes.len().min(self.room);
        self.room -= count;
        self.taken.extend(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_and_what_is_there_is_readable() {
    let subject = Subject::new(zoo_mechanism("planar_4r_general"));
    let whole = bytes(&subject, 70);
    let (all, _) = messages(&whole);
    let rooms = (0..200)
        .chain((200..whole.len()).step_by(997))
        .chain(whole.len() - 40..whole.len());
    for room in rooms {
        let mut disk = Full {
            room,
            taken: Vec::new(),
        };
        match record(&subject, &mut disk, 70) {
            Err(RecordError::Io(error)) => assert_eq!(error.kind(), io::ErrorKind::StorageFull),
            Err(other) => panic!("{other}"),
            Ok(_) => panic!("{room} bytes are not enough"),
        }
        assert!(
            disk.taken == whole[..room],
            "what was written is the log's beginning"
        );
        let (found, _) = messages(&disk.taken);
        assert_eq!(found, all[..found.len()]);
    }
    let mut disk = Full {
        room: whole.len(),
        taken: Vec::new(),
    };
    assert!(record(&subject, &mut disk, 70).is_ok());
}

#[test]
fn nothing_is_written_after_an_error() {
    let subject = Subject::new(zoo_mechanism("planar_4r_general"));
    let mut disk = Full {
        room: 9_000,
        taken: Vec::new(),
    };
    let mut recorder = subject.recorder(&mut disk).unwrap();
    let links = subject.geometry.home.clone();
    let mut failed = 0;
    for moment in 0..200 {
        let motion = Motion::of_links(&links);
        if recorder
            .moment(f64::from(moment), Some(&motion), None)
            .is_err()
        {
            failed += 1;
        }
    }
    assert!(failed > 100);
    assert!(recorder.finish_into().is_err());
}

fn names_in(folder: &PathBuf) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_appears_when_it_is_complete() {
    let folder = empty_folder("appears");
    let path = folder.join("log.mcap");
    std::fs::write(&path, "old").unwrap();
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let recorder = Recorder::create(&path, &subject.header()).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"old");
    assert_eq!(names_in(&folder).len(), 2);
    drop(recorder);
    assert_eq!(names_in(&folder), ["log.mcap"]);
    assert_eq!(std::fs::read(&path).unwrap(), b"old");

    let mut recorder = Recorder::create(&path, &subject.header()).unwrap();
    let motion = Motion::of_links(&subject.geometry.home);
    recorder.moment(0.0, Some(&motion), None).unwrap();
    recorder.moment(0.5, Some(&motion), None).unwrap();
    let summary = recorder.finish_early("interrupted").unwrap();
    assert_eq!((summary.moments, summary.until), (2, 0.5));
    assert_eq!(names_in(&folder), ["log.mcap"]);
    let log = std::fs::read(&path).unwrap();
    let entries: Vec<(u64, Log)> = on_topic(&log, "/log");
    let [(500_000_000, entry)] = entries.as_slice() else {
        panic!("{entries:?}")
    };
    assert_eq!(
        entry.message,
        "stopped early: interrupted; 2 moments recorded, up to 0.5 s"
    );

    let nowhere = folder.join("no").join("such.mcap");
    assert!(matches!(
        Recorder::create(&nowhere, &subject.header()),
        Err(RecordError::Io(_))
    ));
}

/// Chunks are on the disk long before the log ends: this is what a crash leaves.
#[test]
fn an_unfinished_file_is_readable() {
    let folder = empty_folder("unfinished");
    let path = folder.join("log.mcap");
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let mut recorder = Recorder::create(&path, &subject.header()).unwrap();
    for moment in 0..100 {
        let motion = Motion::of_links(&subject.geometry.home);
        recorder
            .moment(f64::from(moment), Some(&motion), None)
            .unwrap();
    }
    let part = folder.join(&names_in(&folder)[0]);
    assert!(part.extension().is_some_and(|e| e == "part"));
    let (found, _) = messages(&std::fs::read(part).unwrap());
    let frames = found.iter().filter(|(topic, _, _)| topic == "/tf").count();
    assert_eq!(frames, 96);
    recorder.finish().unwrap();
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_that_is_full() {
    let full = PathBuf::from("/dev/full");
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let file = LogFile::create(&full).unwrap();
    assert!(matches!(
        record(&subject, file, 50),
        Err(RecordError::Io(_))
    ));
    assert!(full.exists());
}
