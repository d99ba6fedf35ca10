
// The sum of two numbers, and its error.
fn etendue_shader_two_sum(a: f32, b: f32) -> vec2<f32> {
    let sum = a + b;
    let part = sum - a;
    return vec2<f32>(sum, (a - (sum - part)) + (b - part));
}
// a * b + c rounded once where nothing overflows or is subnormal, by numbers of half the digits: Boldo and Melquiond, "Emulation of a FMA and
// correctly rounded sums", 2008.
fn etendue_shader_exact_fma(a: f32, b: f32, c: f32) -> f32 {
    let product = a * b;
    let high = vec2<f32>(bitcast<f32>(bitcast<u32>(a) & 0xfffff000u), bitcast<f32>(bitcast<u32>(b) & 0xfffff000u));
    let low = vec2<f32>(a, b) - high;
    let error = low.x * low.y - (((product - high.x * high.y) - low.x * high.y) - high.x * low.y);
    let small = etendue_shader_two_sum(c, error);
    let large = etendue_shader_two_sum(product, small.x);
    let rest = etendue_shader_two_sum(small.y, large.y);
    // what is not exact is rounded to the neighbour whose last digit is odd
    var bits = bitcast<u32>(rest.x);
    if (rest.y != 0.0 && (bits & 1u) == 0u) {
        bits = select(bits - 1u, bits + 1u, (rest.y > 0.0) == (rest.x > 0.0));
    }
    let result = large.x + bitcast<f32>(bits);
    return select(product + c, result, abs(result) < 3.0e38f);
}
// The neighbour of a positive number to which a remainder belongs that changes by `rate` a unit: exact next to ties, where one division more
// is not.
fn etendue_shader_settled(x: f32, remainder: f32, rate: f32) -> f32 {
    let above = bitcast<f32>(bitcast<u32>(x) + 1u);
    let below = bitcast<f32>(bitcast<u32>(x) - 1u);
    return select(select(x, below, remainder <= -rate * (x - below)), above, remainder > rate * (above - x));
}
// a / b, rounded correctly if the device is wrong by at most 3 units and nothing is subnormal; else the device's own.
fn etendue_shader_exact_quotient(a: f32, b: f32) -> f32 {
    let quotient = a / b;
    let numbers = abs(vec3<f32>(a, b, quotient));
    let near = numbers.z + etendue_shader_exact_fma(-numbers.z, numbers.y, numbers.x) / numbers.y;
    let result = etendue_shader_settled(near, etendue_shader_exact_fma(-near, numbers.y, numbers.x), 0.5f * numbers.y);
    let is_normal = all(numbers > vec3<f32>(1.0e-21f, 3.0e-38f, 3.0e-38f)) && all(numbers < vec3<f32>(1.0e38f));
    return select(quotient, etendue_shader_copysign(result, quotient), is_normal);
}
// The square root, in the same way.
fn etendue_shader_exact_sqrt(x: f32) -> f32 {
    let root = sqrt(x);
    let near = root + etendue_shader_exact_fma(-root, root, x) / (2.0f * root);
    let result = etendue_shader_settled(near, etendue_shader_exact_fma(-near, near, x), near);
    return select(root, result, x > 1.0e-21f && x < 1.0e38f);
}
