#!/bin/bash -eu
# Builds all fuzz targets for ClusterFuzzLite, with their seeds, corpora and dictionaries.
cargo fuzz build -O --features files
for name in $(cargo fuzz list); do
    cp "fuzz/target/x86_64-unknown-linux-gnu/release/$name" "$OUT/"
    corpus=$(mktemp -d)
    cp "fuzz/seeds/$name"/* "$corpus/"
    [ ! -e "fuzz/corpora/$name.tar.gz" ] || tar -xzf "fuzz/corpora/$name.tar.gz" -C "$corpus"
    (cd "$corpus" && zip -qr "$OUT/${name}_seed_corpus.zip" .)
    [ ! -e "fuzz/dictionaries/$name.dict" ] || cp "fuzz/dictionaries/$name.dict" "$OUT/"
done
