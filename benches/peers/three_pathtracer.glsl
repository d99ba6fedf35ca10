// What a host's author writes to use our light sampling: TECHNIQUE and PLACE are filled in by three_pathtracer.py.

// where light is gathered; the host hands its light samplers a point alone
vec3 etendueNormal;

// the host's lights emit from the side of v × u
EtendueShaderRectangle etendueRectangle( Light light ) {
	return EtendueShaderRectangle( light.position - 0.5 * ( light.u + light.v ), light.v, light.u );
}
EtendueShaderDisk etendueDisk( Light light ) {
	return EtendueShaderDisk( light.position, normalize( cross( light.v, light.u ) ), 0.5 * length( light.u ) );
}

float etenduePdf( Light light, vec3 p, vec3 w ) {
	if ( light.type == RECT_AREA_LIGHT_TYPE ) {
		return etendue_shader_rectangle_by_TECHNIQUE_pdf( etendue_shader_rectangle_by_TECHNIQUE_prepare( etendueRectangle( light ), PLACE ), w );
	}
	return etendue_shader_disk_by_solid_angle_pdf( etendue_shader_disk_by_solid_angle_prepare( etendueDisk( light ), p ), w );
}

LightRecord etendueLightSample( Light light, vec3 p, vec2 u ) {
	EtendueShaderLightSample s;
	if ( light.type == RECT_AREA_LIGHT_TYPE ) {
		s = etendue_shader_rectangle_by_TECHNIQUE_sample( etendue_shader_rectangle_by_TECHNIQUE_prepare( etendueRectangle( light ), PLACE ), u );
	} else {
		s = etendue_shader_disk_by_solid_angle_sample( etendue_shader_disk_by_solid_angle_prepare( etendueDisk( light ), p ), u );
	}
	return LightRecord( s.distance_, s.direction, s.emits ? s.pdf : 0.0, light.color * light.intensity, light.type );
}
