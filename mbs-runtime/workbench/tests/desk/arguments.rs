//! Arguments of the command.

use clap::Command;

fn check(command: &Command) {
    for argument in command.get_arguments() {
        // this panics if there is none of a name
        let _ = command.get_arg_conflicts_with(argument);
    }
    command.get_subcommands().for_each(check);
}

/// Names of arguments in the attributes of others are texts. In a release, clap takes a wrong one for none.
#[test]
fn arguments_that_exclude_each_other_exist() {
    let parser = mbs_workbench::app().parser();
    check(&parser);
    parser.debug_assert();
}
