//! `mbs export fmu`.

use std::process::Command;

use super::{mbs, refuses, text};

#[test]
fn units_of_both_versions_are_the_same_bytes_every_time() {
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str| std::fs::read(folder.path().join("units").join(name)).unwrap();
    let names = ["spring_mass_damper_fmi2.fmu", "spring_mass_damper_fmi3.fmu"];
    let mut written = Vec::new();
    for _ in 0..2 {
        let output = mbs(folder.path(), "export fmu spring-mass-damper --out units --sources-only");
        assert!(output.status.success());
        assert!(text(output.stdout).contains("with the C code alone"));
        written.push(names.map(read));
    }
    assert!(written[0] == written[1]);
    // names stand in an archive as they are
    let holds =
        |archive: &[u8], name: &str| archive.windows(name.len()).any(|bytes| bytes == name.as_bytes());
    for archive in &written[0] {
        for name in ["modelDescription.xml", "sources/spring_mass_damper_fmi.c", "documentation/index.html"] {
            assert!(holds(archive, name), "{name}");
        }
    }
    assert!(holds(&written[0][0], "model.png") && holds(&written[0][1], "terminalsAndIcons/icon.png"));
}

#[test]
fn one_version_is_written_if_one_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    // one of whose joints is drawn as a word
    assert!(
        mbs(folder.path(), "export fmu cam-follower --out units --sources-only --fmi 3").status.success()
    );
    let files = std::fs::read_dir(folder.path().join("units")).unwrap();
    let files: Vec<_> = files.map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(files, ["cam_follower_fmi3.fmu"]);
}

#[test]
fn what_is_wrong_is_said() {
    refuses("export fmu pendulum", &["--out"]);
    refuses("export fmu pendulum --out units --fmi 1", &["possible values: 2, 3"]);
    refuses("export fmu pendulum --out units --step 0s", &["step"]);
    refuses("export fmu penulum --out units", &["did you mean `pendulum`"]);
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_mbs"));
    command.args(["export", "fmu", "pendulum", "--out", "units"]).current_dir(folder.path());
    let output = command.env("CC", "no-such-compiler").output().unwrap();
    assert!(!output.status.success());
    let message = text(output.stderr);
    assert!(message.contains("`no-such-compiler` failed; --sources-only does without"), "{message}");
    assert!(!folder.path().join("units").exists());
}
