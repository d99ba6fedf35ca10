
// The sum of two numbers, and its error.
fn two_sum(a: f32, b: f32) -> vec2<f32> {
    let sum = a + b;
    let part = sum - a;
    return vec2<f32>(sum, (a - (sum - part)) + (b - part));
}
// a * b + c rounded once where nothing overflows or is subnormal, by numbers of half the digits: Boldo and Melquiond, "Emulation of a FMA and
// correctly rounded sums", 2008.
fn fused(a: f32, b: f32, c: f32) -> f32 {
    let product = a * b;
    let high = vec2<f32>(bitcast<f32>(bitcast<u32>(a) & 0xfffff000u), bitcast<f32>(bitcast<u32>(b) & 0xfffff000u));
    let low = vec2<f32>(a, b) - high;
    let error = low.x * low.y - (((product - high.x * high.y) - low.x * high.y) - high.x * low.y);
    let small = two_sum(c, error);
    let large = two_sum(product, small.x);
    let rest = two_sum(small.y, large.y);
    // what is not exact is rounded to the neighbour whose last digit is odd
    var bits = bitcast<u32>(rest.x);
    if (rest.y != 0.0 && (bits & 1u) == 0u) {
        bits = select(bits - 1u, bits + 1u, (rest.y > 0.0) == (rest.x > 0.0));
    }
    let result = large.x + bitcast<f32>(bits);
    return select(product + c, result, abs(result) < 3.0e38f);
}
