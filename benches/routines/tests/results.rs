//! `benches/RESULTS.md` has a row of each light, but for latencies, and none of what is no routine.

#[test]
fn results_have_the_rows_of_the_routines() {
    let text = include_str!("../../RESULTS.md");
    let rows: Vec<_> = text.lines().filter_map(|line| Some(line.strip_prefix("| ")?.split_once(" |")?.0)).collect();
    let routines = etendue_routines::routines::<f32>();
    for row in &rows[1..] {
        assert!(routines.iter().any(|routine| routine.name == *row), "no routine is called `{row}`");
    }
    for name in routines.iter().map(|routine| &*routine.name) {
        let is_shown = name.starts_with("light ") && !name.ends_with("in a chain");
        assert!(
            !is_shown || rows.contains(&name),
            "`{name}` is in no row: cargo bench -p etendue-benches --bench summary -- --results"
        );
    }
}
