//! `mbs list`: the mechanisms and what can be set on them.

use clap::Args;

use super::json;
use crate::models::Models;
use crate::{Error, Model, Table, Unit, say};

#[derive(Args)]
#[command(about = "List the mechanisms, their parameters, inputs and outputs")]
pub(crate) struct Arguments {
    /// Print the list as JSON
    #[arg(long)]
    pub json: bool,
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        let models = models.all()?;
        if self.json { say(json::list(&models)) } else { say(text(&models).trim_end()) }
    }
}

fn text(models: &[(&str, &dyn Model)]) -> String {
    let mut table = Table::new(["mechanism", "dof", "", "name", "value", "what it is"]);
    for (name, model) in models {
        let info = model.info();
        let summary = info.doc.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or("");
        table.row([*name, &info.dof.to_string(), "", "", "", summary]);
        let kinds = [
            ("parameter", info.parameters),
            ("input", info.free_inputs()),
            ("memory", info.memories()),
            ("output", info.outputs),
        ];
        for (kind, quantities) in kinds {
            for quantity in quantities {
                let unit = Unit::of(quantity);
                let value =
                    if kind == "output" { unit.name().to_owned() } else { unit.text(quantity.default, 6) };
                let doc = quantity.doc.lines().next().unwrap_or("").trim();
                table.row(["", "", kind, quantity.name, &value, doc]);
            }
        }
    }
    if models.is_empty() {
        return "there are no mechanisms; add one to the App with .mechanism::<M>(\"name\")\n".into();
    }
    table.to_string()
}
