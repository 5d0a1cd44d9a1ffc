//! Output files appear whole or not at all, and a bad path is refused before the work.

use std::fs;
use std::path::{Path, PathBuf};

use symmetrizer::shape::io::Output;
use symmetrizer::{Error, Result};

fn say(output: &mut Output, text: &str) -> Result<()> {
    output.write(|w| w.write_all(text.as_bytes()).map_err(|e| Error::io("", e)))
}

fn names(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap();
    entries.map(|e| e.unwrap().file_name().into()).collect()
}

#[test]
fn the_target_changes_at_the_commit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "before").unwrap();
    let mut output = Output::create(&path).unwrap();
    say(&mut output, "af").unwrap();
    say(&mut output, "ter").unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "before");
    output.commit().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "after");
    assert_eq!(names(folder.path()), [PathBuf::from("a.txt")]);
}

#[test]
fn dropped_output_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let mut output = Output::create(&path).unwrap();
    say(&mut output, "half").unwrap();
    drop(output);
    assert!(names(folder.path()).is_empty());
}

/// Where the system has unnamed files, not even a killed process leaves one.
#[cfg(target_os = "linux")]
#[test]
fn reserved_files_have_no_name() {
    // Not every file system that tests may run on can do this; the usual ones in memory can.
    let Ok(folder) = tempfile::tempdir_in("/dev/shm") else {
        return;
    };
    let path = folder.path().join("a.txt");
    let mut output = Output::create(&path).unwrap();
    say(&mut output, "half").unwrap();
    assert!(names(folder.path()).is_empty());
    output.commit().unwrap();
    assert_eq!(names(folder.path()), [PathBuf::from("a.txt")]);
}

#[test]
fn failure_leaves_the_target_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "before").unwrap();
    let mut output = Output::create(&path).unwrap();
    say(&mut output, "half").unwrap();
    let full = std::io::Error::from(std::io::ErrorKind::StorageFull);
    output.write(|_| Err(Error::io("", full))).unwrap_err();
    drop(output);
    assert_eq!(fs::read_to_string(&path).unwrap(), "before");
    assert_eq!(names(folder.path()), [PathBuf::from("a.txt")]);
}

/// The target is made a directory after the reservation, so that the rename fails.
#[test]
fn a_failing_commit_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let mut output = Output::create(&path).unwrap();
    say(&mut output, "new").unwrap();
    fs::create_dir(&path).unwrap();
    let error = output.commit().unwrap_err().to_string();
    assert!(error.contains("a.txt: "), "{error}");
    assert_eq!(names(folder.path()), [PathBuf::from("a.txt")]);
}

#[test]
fn errors_of_the_content_get_the_path() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let mut output = Output::create(&path).unwrap();
    let full = std::io::Error::other("disk full");
    let error = output.write(|_| Err(Error::io("", full))).unwrap_err();
    assert!(error.to_string().ends_with("a.txt: disk full"), "{error}");
}

#[test]
fn bad_paths_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |path: &Path| Output::create(path).unwrap_err().to_string();
    assert!(refused(folder.path()).contains("directory"));
    let missing = refused(&folder.path().join("none/a.obj"));
    assert!(missing.contains("there is no directory"), "{missing}");
    fs::write(folder.path().join("file"), "").unwrap();
    refused(&folder.path().join("file/a.obj"));
    refused(Path::new(""));
    refused(Path::new("/"));
    refused(Path::new(".."));
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    fn set_mode(path: &Path, mode: u32) {
        fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
    }

    fn write(path: &Path) {
        let mut output = Output::create(path).unwrap();
        say(&mut output, "new").unwrap();
        output.commit().unwrap();
    }

    #[test]
    fn new_files_have_the_usual_mode_and_replaced_ones_keep_theirs() {
        let folder = tempfile::tempdir().unwrap();
        let (usual, ours) = (folder.path().join("usual"), folder.path().join("ours"));
        fs::write(&usual, "").unwrap();
        write(&ours);
        assert_eq!(mode(&ours), mode(&usual));
        set_mode(&ours, 0o640);
        write(&ours);
        assert_eq!(mode(&ours), 0o640);
    }

    #[test]
    fn a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").unwrap();
        symlink(&file, &link).unwrap();
        write(&link);
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }

    #[test]
    fn devices_are_not_replaced() {
        let error = Output::create(Path::new("/dev/null")).unwrap_err();
        assert!(error.to_string().contains("device"), "{error}");
    }

    #[test]
    #[allow(clippy::print_stderr)] // A test that does nothing must not look like one that passed.
    fn protected_places_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "old").unwrap();
        set_mode(&file, 0o444);
        if fs::OpenOptions::new().append(true).open(&file).is_ok() {
            eprintln!("SKIPPED: the superuser may write everywhere");
            return;
        }
        assert!(matches!(Output::create(&file), Err(Error::Io { .. })));
        set_mode(folder.path(), 0o555);
        let new = Output::create(&folder.path().join("new"));
        set_mode(folder.path(), 0o755);
        assert!(matches!(new, Err(Error::Io { .. })));
    }
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_nowhere_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("link.obj");
    std::os::unix::fs::symlink("none.obj", &link).unwrap();
    let message = Output::create(&link).unwrap_err().to_string();
    assert!(
        message.contains("link.obj") && message.contains("not there"),
        "{message}"
    );
    assert!(link.is_symlink());
}
