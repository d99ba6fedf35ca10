//! Equal input gives the same bits on every processor: all hashes are those of `tests/bits/bits.txt`. `.ci/bits` compares them on other
//! processors.

use etendue_bits::{REPLACE, RoutineHashes, TABLE, differences, rows, text};

/// Only builds that promise it: `etendue::real::SAME_BITS`.
#[cfg_attr(
    not(any(target_feature = "fma", target_arch = "aarch64")),
    ignore = "products and sums of this build are rounded twice"
)]
#[test]
fn every_routine_returns_the_bits_of_the_table() {
    let differences = differences(&rows(), TABLE);
    assert!(
        differences.is_empty(),
        "{}\nA change to the bits is breaking, and the changelog names it. If this one is intended, `{REPLACE}` replaces the table.",
        differences.join("\n")
    );
}

#[test]
fn every_difference_is_named() {
    let row = |name: &str, single, double| RoutineHashes {
        name: name.to_owned(),
        hashes: [single, double],
        faults: Vec::new(),
    };
    let rows = [row("a", 1, 2), row("b", 3, 4)];
    let table = text(&rows);
    assert_eq!(table, "a 0000000000000001 0000000000000002\nb 0000000000000003 0000000000000004\n");
    assert_eq!(differences(&rows, &table), [""; 0]);
    let changed = [row("a", 1, 5), row("c", 3, 4)];
    let expected = [
        "a: double precision differs from the table",
        "c: not in the table",
        "b 0000000000000003 0000000000000004: no such routine",
    ];
    assert_eq!(differences(&changed, &table), expected);
    let faulty =
        [RoutineHashes { faults: vec!["f32x8 differs from f32".to_owned()], ..row("a", 1, 2) }, row("b", 3, 4)];
    assert_eq!(differences(&faulty, &table), ["a: f32x8 differs from f32"]);
}
