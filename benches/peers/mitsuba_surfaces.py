"""The glossy surfaces of pbrt 4, as a plugin in Python for Mitsuba 3 that it compiles. Set a variant before this is imported.

Mitsuba's own rough conductor masks and shadows independently of each other, so that it is darker at grazing angles.
"""
import math

import drjit as dr
import mitsuba as mi

# of a metal; at 1, k would be infinite
MOST_REFLECTANCE = 0.9999


class Glossy(mi.BSDF):
    """GGX of roughness `alpha` with correlated masking and shadowing. Without `coated`, a metal of the index 1 + ki that reflects `specular` at
    normal incidence; with it, Schlick's reflectance of `specular` over a diffuse surface of the reflectance `red`, `green`, `blue`."""

    def __init__(self, props):
        super().__init__(props)
        self.alpha, self.specular, self.coated = props['alpha'], props['specular'], props['coated']
        self.diffuse = [props[name] for name in ['red', 'green', 'blue']]
        specular = min(self.specular, MOST_REFLECTANCE)
        self.k = 2 * math.sqrt(specular / (1 - specular))
        flags = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
        if self.coated:
            flags = flags | mi.BSDFFlags.DiffuseReflection
        self.m_components, self.m_flags = [flags], flags

    def microfacets(self):
        return mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.alpha, True)

    def fresnel(self, cos):
        if self.coated:
            away = 1 - dr.clip(cos, 0, 1)
            return self.specular + (1 - self.specular) * dr.square(dr.square(away)) * away
        return mi.fresnel_conductor(cos, mi.Complex2f(1, self.k))

    def share(self, wi):
        """Probability of a reflection by the microfacets."""
        if not self.coated:
            return mi.Float(1)
        above = self.fresnel(mi.Frame3f.cos_theta(wi))
        return dr.clip(above / (above + (1 - above) * max(self.diffuse)), 0.1, 0.9)

    def lambda_plus(self, w):
        """1 + 2Λ of Smith's function."""
        return dr.sqrt(1 + self.alpha ** 2 * (dr.square(w.x) + dr.square(w.y)) / dr.square(w.z))

    def eval_pdf(self, ctx, si, wo, active=True):
        wi = si.wi
        active = mi.Bool(active) & (mi.Frame3f.cos_theta(wi) > 0) & (mi.Frame3f.cos_theta(wo) > 0)
        m = dr.normalize(wi + wo)
        microfacets = self.microfacets()
        reflectance = self.fresnel(dr.dot(wi, m))
        shine = reflectance * microfacets.eval(m) / (4 * wi.z) * 2 / (self.lambda_plus(wi) + self.lambda_plus(wo))
        value = mi.Color3f(shine)
        own = microfacets.pdf(wi, m) / (4 * dr.dot(wo, m))
        cosine = wo.z / math.pi
        if self.coated:
            value += mi.Color3f(self.diffuse) * (1 - reflectance) * cosine
        pdf = dr.lerp(cosine, own, self.share(wi))
        return dr.select(active, value, 0), dr.select(active, pdf, 0)

    def eval(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[1]

    def sample(self, ctx, si, sample1, sample2, active=True):
        m, _ = self.microfacets().sample(si.wi, sample2)
        wo = mi.reflect(si.wi, m)
        if self.coated:
            wo = dr.select(sample1 < self.share(si.wi), wo, mi.warp.square_to_cosine_hemisphere(sample2))
        value, pdf = self.eval_pdf(ctx, si, wo, active)
        found = dr.zeros(mi.BSDFSample3f)
        found.wo, found.pdf, found.eta, found.sampled_component = wo, pdf, 1, 0
        found.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
        return found, dr.select(pdf > 0, value / pdf, 0)

    def to_string(self):
        return f'Glossy[alpha = {self.alpha}, coated = {self.coated}]'


mi.register_bsdf('glossy', Glossy)
