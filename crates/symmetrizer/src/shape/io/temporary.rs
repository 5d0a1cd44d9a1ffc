//! Temporary files that leave nothing behind.
//!
//! On Linux a file without a name vanishes with the process, however that ends; it gets a name only
//! for the rename. Elsewhere, and on file systems that cannot do this, the file has a name from the
//! start, which a killed process leaves behind.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use tempfile::{Builder, NamedTempFile};

/// A file that is being written.
#[derive(Debug)]
pub(super) enum Temporary {
    /// Without a name.
    #[cfg(target_os = "linux")]
    Unnamed(File),
    /// With a name of its own.
    Named(NamedTempFile),
}

impl Temporary {
    /// A new file in `directory`.
    pub fn create(directory: &Path) -> io::Result<Self> {
        #[cfg(target_os = "linux")]
        if let Some(file) = unnamed(directory) {
            return Ok(Self::Unnamed(file));
        }
        builder().tempfile_in(directory).map(Self::Named)
    }

    /// The file.
    pub fn file(&self) -> &File {
        match self {
            #[cfg(target_os = "linux")]
            Self::Unnamed(file) => file,
            Self::Named(file) => file.as_file(),
        }
    }

    /// Puts the file in the place of `target`, in one step; both are in `directory`.
    pub fn rename(self, directory: &Path, target: &Path) -> io::Result<()> {
        match self {
            #[cfg(target_os = "linux")]
            Self::Unnamed(file) => {
                let named = builder().make_in(directory, |path| link(&file, path));
                let path = match named {
                    Ok(named) => named.into_temp_path(),
                    // Some file systems know unnamed files but cannot name them later.
                    Err(_) => copied(&file, directory)?.into_temp_path(),
                };
                path.persist(target)?;
            }
            Self::Named(file) => drop(file.persist(target)?),
        }
        Ok(())
    }
}

impl Write for Temporary {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file().flush()
    }
}

/// Names and permissions of temporary files; the permissions are those of any new file.
fn builder() -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(".symmetrizer-").suffix(".tmp");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

/// A file without a name, where the system has that and can name it later.
#[cfg(target_os = "linux")]
fn unnamed(directory: &Path) -> Option<File> {
    use rustix::fs::{CWD, Mode, OFlags, openat};

    let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
    let file = File::from(openat(CWD, directory, flags, Mode::from_raw_mode(0o666)).ok()?);
    handle(&file).symlink_metadata().is_ok().then_some(file)
}

/// The path by which the system knows an open file.
#[cfg(target_os = "linux")]
fn handle(file: &File) -> std::path::PathBuf {
    use std::os::fd::AsRawFd;

    format!("/proc/self/fd/{}", file.as_raw_fd()).into()
}

/// Gives an unnamed file the name `path`.
#[cfg(target_os = "linux")]
fn link(file: &File, path: &Path) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD, linkat};

    let linked = linkat(CWD, handle(file), CWD, path, AtFlags::SYMLINK_FOLLOW);
    linked.map_err(io::Error::from)
}

/// The same bytes and permissions in a file with a name.
#[cfg(target_os = "linux")]
fn copied(mut file: &File, directory: &Path) -> io::Result<NamedTempFile> {
    use std::io::Seek;

    let mut copy = builder().tempfile_in(directory)?;
    file.rewind()?;
    io::copy(&mut file, &mut copy)?;
    copy.as_file()
        .set_permissions(file.metadata()?.permissions())?;
    copy.as_file().sync_all()?;
    Ok(copy)
}
