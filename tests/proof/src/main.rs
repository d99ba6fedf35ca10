//! Proves the theorems: `cargo run --release -p etendue-proof -- [--whole] [NAME…]`.

use etendue_proof::search::{prove, try_points};
use etendue_proof::{lemmas, theorems};
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let (mut whole, mut names) = (false, Vec::new());
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--whole" => whole = true,
            option if option.starts_with('-') => {
                eprintln!("etendue-proof: unknown option {option}; usage: etendue-proof [--whole] [NAME…]");
                return ExitCode::from(2);
            }
            name => names.push(name.to_lowercase()),
        }
    }
    let mut proved = true;
    if names.is_empty() {
        for lemma in lemmas::all() {
            let began = Instant::now();
            let found = lemma.check(whole);
            proved &= found.holds;
            let errors: Vec<String> = found
                .greatest
                .iter()
                .map(|most| most.map(|most| (most.error(), most.at().unwrap_or_default())))
                .map(|[(error, at), (over, over_at)]| format!("{error:.3e} at {at:e}, {over:.3e}·x at {over_at:e}"))
                .collect();
            println!(
                "{} {}\n    {} arguments in {:.1} s; greatest errors: {}",
                if found.holds { "Lemma." } else { "NOT TRUE:" },
                lemma.statement,
                found.tried,
                began.elapsed().as_secs_f64(),
                errors.join("; ")
            );
        }
    }
    for theorem in theorems::all(whole) {
        let statement = theorem.statement();
        if !names.is_empty() && !names.iter().any(|name| statement.name.to_lowercase().contains(name)) {
            continue;
        }
        let began = Instant::now();
        let (difference, at) = try_points(&*theorem, 100_000);
        let proof = prove(&*theorem, if whole { 30_000_000 } else { 1_000_000 });
        let tried = theorem.trial().map(|trial| (trial.what, trial.run()));
        let holds = proof.failed.is_none() && difference < 1e-9 && tried.is_none_or(|(_, pairs)| pairs.is_some());
        proved &= holds;
        println!("{} {}: for {}", if holds { "Theorem." } else { "NOT PROVED:" }, statement.name, statement.domain);
        for (limit, greatest) in statement.limits.iter().zip(&proof.greatest) {
            println!("    {} ≤ {:.3e} (proved: {greatest:.3e})", limit.what, limit.most);
        }
        match tried {
            Some((what, Some(pairs))) => println!("    {what}: tried for {pairs} pairs u"),
            Some((what, None)) => println!("    not true: {what}"),
            None => {}
        }
        println!(
            "    {} boxes in {:.1} s; differs from its definition by {difference:.1e} at 100,000 points",
            proof.boxes,
            began.elapsed().as_secs_f64()
        );
        if let Some((part, bounds)) = &proof.failed {
            println!("    not proved: {bounds:?} on {part:?}");
        }
        if difference >= 1e-9 {
            println!("    differs from its definition at {at:?}");
        }
    }
    if proved { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
