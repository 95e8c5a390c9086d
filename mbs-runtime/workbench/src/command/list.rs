//! `mbs list`: the mechanisms and what can be set on them.

use clap::Command;
use mbs_runtime::Quantity;

use crate::app::Models;
use crate::number::significant;
use crate::{Error, Table, quantity, say};

pub(crate) fn command() -> Command {
    Command::new("list").about("List the mechanisms, their parameters and inputs")
}

pub(crate) fn run(models: &Models) -> Result<(), Error> {
    say(text(models).trim_end());
    Ok(())
}

fn text(models: &Models) -> String {
    let mut table = Table::new(["mechanism", "dof", "", "name", "value", "what it is"]);
    for (name, model) in models.iter() {
        let info = model.info();
        let summary = info.doc.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or("");
        table.row([name, &info.dof.to_string(), "", "", "", summary]);
        let kinds = [("parameter", info.parameters), ("input", info.inputs), ("output", info.outputs)];
        for (kind, quantities) in kinds {
            for quantity in quantities {
                let value = if kind == "output" { unit(quantity) } else { value(quantity) };
                let doc = quantity.doc.lines().next().unwrap_or("").trim();
                table.row(["", "", kind, quantity.name, &value, doc]);
            }
        }
    }
    if models.iter().next().is_none() {
        return "there are no mechanisms; add one to the App with .mechanism::<M>(\"name\")\n".into();
    }
    table.to_string()
}

/// The declared value in the declared unit.
fn value(quantity: &Quantity) -> String {
    let scale = if quantity.scale == 0.0 { 1.0 } else { quantity.scale };
    format!("{} {}", significant(quantity.default / scale, 6), unit(quantity)).trim_end().to_owned()
}

fn unit(quantity: &Quantity) -> String {
    match (quantity.unit, quantity::si_unit(quantity.dimension).as_str()) {
        ("", "1") => String::new(),
        ("", si) => si.to_owned(),
        (declared, _) => declared.to_owned(),
    }
}
