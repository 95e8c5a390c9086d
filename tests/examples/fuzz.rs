//! Compiles declarations that nobody would write, for as long as it is told:
//!
//! ```text
//! cargo run --release -p tests --example fuzz -- --minutes 10 --seed 1
//! ```
//!
//! Inputs are compiled in child processes of limited memory, each input in limited
//! time, so that an overflow of the stack or a runaway compilation is attributed to
//! its input and the run goes on. What
//! fails is cut down to its smallest part and written to `tests/corpus`; the run
//! depends on nothing but `--seed` and its length.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a tool for a terminal")]

use std::collections::{BTreeMap, HashSet};
use std::error::Error;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use tests::fuzzing::verdict::{Verdict, judge, record_panics};
use tests::fuzzing::{input, reduction, seeds};

const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/corpus");
/// Inputs of one child process.
const BATCH: u64 = 2_000;
/// Cutting down one finding.
const REDUCTION: Duration = Duration::from_secs(60);
/// KiB of memory that a child process may take, where the system can hold it to that.
const MEMORY: u32 = 4 << 20;

/// The words whose share in what compiles is reported.
fn words() -> Vec<&'static str> {
    let keywords = mbs_codegen::keywords().into_iter().map(|keyword| keyword.word);
    keywords.chain(["invisible"]).collect()
}

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

fn main() -> Outcome {
    let options = Options::read()?;
    match options.child {
        Some(Task::Batch { first }) => batch(&options, first),
        Some(Task::One) => one(&options),
        None => fuzz(&options),
    }
}

struct Options {
    minutes: f64,
    seed: u64,
    /// Seconds that one input may take.
    limit: f64,
    child: Option<Task>,
}

enum Task {
    /// Inputs from this number on.
    Batch { first: u64 },
    /// The text at standard input.
    One,
}

impl Options {
    fn read() -> Outcome<Self> {
        let mut options = Self { minutes: 1.0, seed: 1, limit: 5.0, child: None };
        let mut arguments = std::env::args().skip(1);
        while let Some(name) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("`{name}` needs a value"));
            match name.as_str() {
                "--minutes" => options.minutes = value()?.parse()?,
                "--seed" => options.seed = value()?.parse()?,
                "--limit" => options.limit = value()?.parse()?,
                "--batch" => options.child = Some(Task::Batch { first: value()?.parse()? }),
                "--one" => options.child = Some(Task::One),
                _ => return Err(format!("no option `{name}`; --minutes, --seed and --limit are").into()),
            }
        }
        Ok(options)
    }

    fn limit(&self) -> Duration {
        Duration::from_secs_f64(self.limit)
    }

    /// This program, doing something for itself.
    fn child(&self, task: &[String]) -> io::Result<Child> {
        let of_run =
            ["--seed".to_owned(), self.seed.to_string(), "--limit".to_owned(), self.limit.to_string()];
        let this = std::env::current_exe()?;
        let mut command = match cfg!(unix) {
            // what a shell is held to, its successor is too
            true => {
                let mut shell = Command::new("sh");
                shell.arg("-c").arg(format!("ulimit -v {MEMORY}; exec \"$0\" \"$@\"")).arg(this);
                shell
            }
            false => Command::new(this),
        };
        command
            .args(of_run.iter().chain(task))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
    }
}

/// A line before each input, its number, and one behind it, the verdict.
fn batch(options: &Options, first: u64) -> Outcome {
    record_panics();
    let seeds = seeds::all();
    let mut out = io::stdout().lock();
    for index in first..first + BATCH {
        writeln!(out, "{index}")?;
        out.flush()?;
        let text = input(&seeds, options.seed, index);
        let verdict = judge(&text, options.limit());
        let words = if verdict == Verdict::Compiled { words_in(&text) } else { String::new() };
        writeln!(out, "{verdict:?}\t{words}")?;
        out.flush()?;
        // the thread that is left behind ends with the process
        if verdict == Verdict::TooSlow {
            break;
        }
    }
    Ok(())
}

fn words_in(text: &str) -> String {
    let all: HashSet<&str> = text.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
    words().into_iter().filter(|word| all.contains(word)).collect::<Vec<_>>().join(" ")
}

fn one(options: &Options) -> Outcome {
    record_panics();
    let mut text = String::new();
    io::stdin().read_to_string(&mut text)?;
    println!("{:?}", judge(&text, options.limit()));
    Ok(())
}

/// Counts of the verdicts of a run.
#[derive(Default)]
struct Tally {
    inputs: u64,
    compiled: u64,
    refused: u64,
    no_tokens: u64,
    /// Inputs that were too slow, but not again.
    once_slow: u64,
    words: BTreeMap<String, u64>,
    /// How often each failure occurred.
    failures: BTreeMap<String, u64>,
}

fn fuzz(options: &Options) -> Outcome {
    let seeds = seeds::all();
    let end = Instant::now() + Duration::from_secs_f64(60.0 * options.minutes);
    let bar = ProgressBar::no_length();
    bar.set_style(ProgressStyle::with_template("{spinner} {elapsed} {pos} inputs, {per_sec} {msg}")?);
    let mut tally = Tally::default();
    let mut next = 0;
    while Instant::now() < end {
        let mut child = options.child(&["--batch".to_owned(), next.to_string()])?;
        let mut pending = None;
        let lines = child.stdout.take().map(|out| BufReader::new(out).lines());
        for line in lines.into_iter().flatten() {
            let line = line?;
            let Some((verdict, words)) = line.split_once('\t') else {
                pending = line.parse().ok();
                continue;
            };
            if let Some(index) = pending.take() {
                next = index + 1;
                note(&mut tally, verdict, words, || input(&seeds, options.seed, index), options, &bar)?;
            }
            if Instant::now() > end {
                break;
            }
        }
        child.kill()?;
        let status = child.wait()?;
        // it died at its work; not of `kill` at the end of the run
        if let Some(index) = pending
            && Instant::now() < end
        {
            next = index + 1;
            let death = format!("Died({status})");
            note(&mut tally, &death, "", || input(&seeds, options.seed, index), options, &bar)?;
        }
    }
    bar.finish_and_clear();
    report(&tally);
    match tally.failures.is_empty() {
        true => Ok(()),
        false => Err("the compiler failed on some inputs; their smallest parts are in tests/corpus".into()),
    }
}

fn note(
    tally: &mut Tally,
    verdict: &str,
    words: &str,
    text: impl FnOnce() -> String,
    options: &Options,
    bar: &ProgressBar,
) -> Outcome {
    tally.inputs += 1;
    bar.inc(1);
    match verdict {
        "Compiled" => tally.compiled += 1,
        "Refused" => tally.refused += 1,
        "NoTokens" => tally.no_tokens += 1,
        failure => {
            let text = text();
            // The machine may have been busy.
            if failure == "TooSlow" && verdict_of(&text, options)? != failure {
                tally.once_slow += 1;
                return Ok(());
            }
            let times = tally.failures.entry(failure.to_owned()).or_default();
            *times += 1;
            // Failures at the same place are looked at once, inputs that take too long a few times.
            let most = if failure == "TooSlow" { 8 } else { 1 };
            if *times <= most {
                keep(&text, failure, options, bar)?;
            }
        }
    }
    for word in words.split_whitespace() {
        *tally.words.entry(word.to_owned()).or_default() += 1;
    }
    bar.set_message(format!("{} compiled, {} kinds of failure", tally.compiled, tally.failures.len()));
    Ok(())
}

/// Cuts an input down and writes it to the corpus.
fn keep(text: &str, failure: &str, options: &Options, bar: &ProgressBar) -> Outcome {
    let end = Instant::now() + REDUCTION;
    let fails = |text: &str| verdict_of(text, options).is_ok_and(|found| found == failure);
    let stop = || Instant::now() > end;
    let text = if fails(text) { reduction::smallest(text, fails, stop) } else { text.to_owned() };
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    let path = format!("{CORPUS}/{:016x}.txt", hasher.finish());
    std::fs::create_dir_all(CORPUS)?;
    std::fs::write(&path, &text)?;
    let beginning: String = text.chars().take(400).collect();
    bar.suspend(|| eprintln!("{failure}\n  {path}\n  {beginning}"));
    Ok(())
}

/// The verdict of a child process on a text, or how it died.
fn verdict_of(text: &str, options: &Options) -> Outcome<String> {
    let mut child = options.child(&["--one".to_owned()])?;
    if let Some(mut to) = child.stdin.take() {
        to.write_all(text.as_bytes())?;
    }
    let output = child.wait_with_output()?;
    let verdict = String::from_utf8(output.stdout)?;
    Ok(if verdict.is_empty() { format!("Died({})", output.status) } else { verdict.trim_end().to_owned() })
}

fn report(tally: &Tally) {
    let Tally { inputs, compiled, refused, no_tokens, once_slow, .. } = tally;
    println!(
        "{inputs} inputs: {compiled} compiled, {refused} refused, {no_tokens} no tokens, {once_slow} slow once"
    );
    println!("in those that compiled:");
    for word in words() {
        println!("  {word:16} {}", tally.words.get(word).unwrap_or(&0));
    }
    for (failure, times) in &tally.failures {
        println!("{times} times {failure}");
    }
}
