//! `symmetrize params`, and what the help says.

mod common;

use common::{Desk, stdout};

#[test]
fn the_parameters_printed_can_be_read_again() {
    let desk = Desk::new();
    let set = ["params", "--set", "optimize.step=0.125"];
    let printed = stdout(&desk.symmetrize(&set).assert().success());
    assert!(printed.contains("step = 0.125"), "{printed}");
    desk.write("p.toml", &printed);
    let read = ["params", "--params", "p.toml"];
    assert_eq!(stdout(&desk.symmetrize(&read).assert().success()), printed);
    let over = [
        "params",
        "--params",
        "p.toml",
        "--set",
        "optimize.step=0.25",
    ];
    let changed = stdout(&desk.symmetrize(&over).assert().success());
    assert!(changed.contains("step = 0.25"), "{changed}");
}

#[test]
fn every_verb_helps() {
    let desk = Desk::new();
    let help = stdout(&desk.symmetrize(&["--help"]).assert().success());
    assert!(help.contains("Exit codes: 0 done; 1 no symmetry found"));
    for verb in ["run", "detect", "plot", "measure", "render", "params"] {
        assert!(help.contains(&format!("\n  {verb} ")), "{verb} in\n{help}");
        let text = stdout(&desk.symmetrize(&[verb, "--help"]).assert().success());
        for flag in ["--seed", "--threads", "--quiet"] {
            assert!(text.contains(flag), "{verb}: {flag}");
        }
        // The first line says what the verb does, without a full stop.
        let first = text.lines().next().unwrap();
        assert!(first.len() > 10 && !first.ends_with('.'), "{verb}: {first}");
    }
    desk.symmetrize(&[]).assert().code(2);
    desk.symmetrize(&["fold"]).assert().code(2);
}
