//! Points, directions and orthonormal frames over scalars or packets.

pub(crate) mod double_word;

#[doc(hidden)]
pub use double_word::{height_dw, sum_dw};

use crate::lanewise::{lanewise, only};
use crate::math::{difference_of_products, rsqrt};
use crate::real::Real;
use core::ops::{Add, AddAssign, Div, Index, Mul, Neg, Sub};

macro_rules! vector {
    (@count $x:ident $y:ident) => { 2 };
    (@count $x:ident $y:ident $z:ident) => { 3 };
    ($(#[$doc:meta])* $name:ident { $($axis:ident),+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        #[repr(C)]
        pub struct $name<R> {
            $(#[doc = concat!("Component ", stringify!($axis), ".")] pub $axis: R,)+
        }
        impl<R> $name<R> {
            /// The vector with these components.
            #[inline(always)]
            pub const fn new($($axis: R),+) -> Self {
                Self { $($axis),+ }
            }
            /// The components in order.
            #[inline(always)]
            pub fn to_array(self) -> [R; vector!(@count $($axis)+)] {
                [$(self.$axis),+]
            }
            /// Replaces each component x by `f(x)`.
            #[inline(always)]
            pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> $name<S> {
                $name { $($axis: f(self.$axis)),+ }
            }
        }
        impl<R: Real> $name<R> {
            /// 0 in all components.
            pub const ZERO: Self = Self { $($axis: R::ZERO),+ };

            /// Repeats one vector in every lane.
            #[inline(always)]
            pub fn splat(v: $name<R::Scalar>) -> Self {
                v.map(R::splat)
            }
            /// The vector of lane `i`. Panics past the last lane.
            #[inline(always)]
            pub fn lane(self, i: usize) -> $name<R::Scalar> {
                $name { $($axis: self.$axis.lane(i)),+ }
            }
            /// Takes the lanes of `yes` where the mask is true, and those of `no` elsewhere.
            #[inline(always)]
            pub fn blend(mask: R::Mask, yes: Self, no: Self) -> Self {
                $crate::real::Blend::<R>::blended(mask, yes, no)
            }
            /// `self * scale + other`.
            #[inline(always)]
            pub fn mul_add(self, scale: R, other: Self) -> Self {
                Self { $($axis: self.$axis.mul_add(scale, other.$axis)),+ }
            }
            /// Squared length.
            #[inline(always)]
            pub fn length_squared(self) -> R {
                self.dot(self)
            }
            /// Length; 0 for a vector so short that its square underflows.
            #[inline(always)]
            pub fn length(self) -> R {
                self.length_squared().sqrt()
            }
        }
        $crate::real::blended!($name { $($axis),+ });
        impl<R: Real> Add for $name<R> {
            type Output = Self;
            #[inline(always)]
            fn add(self, o: Self) -> Self {
                Self { $($axis: self.$axis + o.$axis),+ }
            }
        }
        impl<R: Real> AddAssign for $name<R> {
            #[inline(always)]
            fn add_assign(&mut self, o: Self) {
                *self = *self + o;
            }
        }
        impl<R: Real> Sub for $name<R> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, o: Self) -> Self {
                Self { $($axis: self.$axis - o.$axis),+ }
            }
        }
        impl<R: Real> Mul<R> for $name<R> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, s: R) -> Self {
                Self { $($axis: self.$axis * s),+ }
            }
        }
        /// A quotient for each component, rounded once.
        impl<R: Real> Div<R> for $name<R> {
            type Output = Self;
            #[inline(always)]
            fn div(self, s: R) -> Self {
                Self { $($axis: self.$axis / s),+ }
            }
        }
        /// The components in order. Panics past the last one.
        impl<R> Index<usize> for $name<R> {
            type Output = R;
            #[inline(always)]
            fn index(&self, axis: usize) -> &R {
                [$(&self.$axis),+][axis]
            }
        }
        impl<R: Real> Neg for $name<R> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self { $($axis: -self.$axis),+ }
            }
        }
    };
}
vector!(
    /// A point of a plane or of the unit square, over a scalar or a packet.
    Vec2 { x, y }
);
vector!(
    /// A point or a direction in space, over a scalar or a packet. The default is 0.
    ///
    /// ```
    /// use etendue::Vec3;
    /// let v = 0.25 * (Vec3::new(4.0, 8.0, 12.0_f32) / 2.0) * 2.0 - Vec3::ZERO;
    /// assert_eq!((v, v[2], v.to_array()), ([1.0, 2.0, 3.0].into(), 3.0, [1.0, 2.0, 3.0]));
    /// ```
    Vec3 { x, y, z }
);

impl<R: Real> Vec2<R> {
    /// The constants nearest to these components, in every lane.
    #[inline(always)]
    pub fn lit([x, y]: [f64; 2]) -> Self {
        Self { x: R::lit(x), y: R::lit(y) }
    }
    /// Inner product.
    #[inline(always)]
    pub fn dot(self, o: Self) -> R {
        self.x.mul_add(o.x, self.y * o.y)
    }
}

only!(Vec3 { x: R, y: R, z: R });

impl<R: Real> Vec3<R> {
    /// Inner product.
    #[inline(always)]
    pub fn dot(self, o: Self) -> R {
        self.x.mul_add(o.x, self.y.mul_add(o.y, self.z * o.z))
    }
    /// Cross product; each component is accurate to 1.5 ulp, however nearly parallel the factors are.
    #[inline(always)]
    pub fn cross(self, o: Self) -> Self {
        Self {
            x: difference_of_products(self.y, o.z, self.z, o.y),
            y: difference_of_products(self.z, o.x, self.x, o.z),
            z: difference_of_products(self.x, o.y, self.y, o.x),
        }
    }
    /// The unit vector in this direction; 0 in lanes whose squared length is 0.
    #[inline(always)]
    pub fn normalize(self) -> Self {
        let squared = self.length_squared();
        self * rsqrt(squared).keep(squared.gt(R::lit(0.0)))
    }
    /// Unit vector and length, at any scale; 0 and 0 for the zero vector.
    #[inline(always)]
    pub fn unit_and_length(self) -> (Self, R) {
        let scale = self.max_abs().pow2_scale();
        let v = self * scale;
        let squared = v.length_squared();
        let inverse = rsqrt(squared).keep(squared.gt(R::lit(0.0)));
        (v * inverse, squared * inverse / scale)
    }
    /// `|self|² − r²` as if computed in twice the working precision and rounded once.
    #[inline(always)]
    pub fn length_squared_minus_square(self, r: R) -> R {
        let square = |a: R| {
            let p = a * a;
            (p, R::two_prod_error(a, a, p))
        };
        let ((x, ex), (y, ey), (z, ez), (q, eq)) = (square(self.x), square(self.y), square(self.z), square(r));
        let (s, e1) = x.two_sum(-q);
        let (s, e2) = s.two_sum(y);
        let (s, e3) = s.two_sum(z);
        s + ((e1 + e2 + e3) + ((ex - eq) + (ey + ez)))
    }
    /// The vector where the mask is true, 0 elsewhere.
    #[inline(always)]
    pub fn keep(self, mask: R::Mask) -> Self {
        Self { x: self.x.keep(mask), y: self.y.keep(mask), z: self.z.keep(mask) }
    }
    /// The constants nearest to these components, in every lane.
    #[inline(always)]
    pub fn lit([x, y, z]: [f64; 3]) -> Self {
        Self { x: R::lit(x), y: R::lit(y), z: R::lit(z) }
    }
    /// Largest magnitude of a component that is a number.
    #[inline(always)]
    pub fn max_abs(self) -> R {
        self.x.abs().greater(self.y.abs()).greater(self.z.abs())
    }
    /// True where all components are numbers of magnitudes below `most`.
    #[inline(always)]
    pub(crate) fn is_within(self, most: R) -> R::Mask {
        self.x.abs().lt(most) & self.y.abs().lt(most) & self.z.abs().lt(most)
    }
}

lanewise! {
    /// A right-handed orthonormal frame whose local z axis is a given direction.
    pub struct Frame {
        /// Local x axis, a unit vector.
        pub s: Vec3<R>,
        /// Local y axis, a unit vector.
        pub t: Vec3<R>,
        /// Local z axis, a unit vector.
        pub n: Vec3<R>,
    }
}

impl<R: Real> Frame<R> {
    /// The frame about the unit vector `n`, continuous except for a jump where `n.z` changes sign.
    ///
    /// It is orthonormal to 2.4e−7 for any unit `n`, including `n.z = −1`. Source: Duff et al., "Building an Orthonormal Basis,
    /// Revisited", JCGT 6(1), 2017, listing 3.
    #[inline(always)]
    pub fn new(n: Vec3<R>) -> Self {
        let sign = R::lit(1.0).copysign(n.z);
        let a = R::lit(-1.0) / (sign + n.z);
        let b = n.x * n.y * a;
        Self {
            s: Vec3::new((sign * n.x * a).mul_add(n.x, R::lit(1.0)), sign * b, -(sign * n.x)),
            t: Vec3::new(b, (n.y * a).mul_add(n.y, sign), -n.y),
            n,
        }
    }
    /// Maps local coordinates to the space of the frame.
    #[inline(always)]
    pub fn to_world(&self, v: Vec3<R>) -> Vec3<R> {
        self.s.mul_add(v.x, self.t.mul_add(v.y, self.n * v.z))
    }
    /// Maps a vector in the space of the frame to local coordinates.
    #[inline(always)]
    pub fn to_local(&self, v: Vec3<R>) -> Vec3<R> {
        Vec3::new(v.dot(self.s), v.dot(self.t), v.dot(self.n))
    }
}
