// What a host's author writes to use our light sampling: TECHNIQUE and PLACE are filled in by three_pathtracer.py.

// where light is gathered; the host hands its light samplers a point alone
vec3 etendueNormal;

// the host's lights emit from the side of v × u
EtendueRectangle etendueRectangle( Light light ) {
	return EtendueRectangle( light.position - 0.5 * ( light.u + light.v ), light.v, light.u );
}
EtendueDisk etendueDisk( Light light ) {
	return EtendueDisk( light.position, normalize( cross( light.v, light.u ) ), 0.5 * length( light.u ) );
}

float etenduePdf( Light light, vec3 p, vec3 w ) {
	if ( light.type == RECT_AREA_LIGHT_TYPE ) {
		return etendue_rectangle_by_TECHNIQUE_pdf( etendue_rectangle_by_TECHNIQUE_prepare( etendueRectangle( light ), PLACE ), w );
	}
	return etendue_disk_by_solid_angle_pdf( etendue_disk_by_solid_angle_prepare( etendueDisk( light ), p ), w );
}

LightRecord etendueLightSample( Light light, vec3 p, vec2 u ) {
	EtendueLightSample s;
	if ( light.type == RECT_AREA_LIGHT_TYPE ) {
		s = etendue_rectangle_by_TECHNIQUE_sample( etendue_rectangle_by_TECHNIQUE_prepare( etendueRectangle( light ), PLACE ), u );
	} else {
		s = etendue_disk_by_solid_angle_sample( etendue_disk_by_solid_angle_prepare( etendueDisk( light ), p ), u );
	}
	return LightRecord( s.distance_, s.direction, s.emits ? s.pdf : 0.0, light.color * light.intensity, light.type );
}
