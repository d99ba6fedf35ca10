//! Rooms on a lattice, so that their parts touch, coincide and are parallel, whose proofs must agree with the oracle.

use etendue_judge::generators::Random;
use etendue_judge::proofs::{Room, own};

/// No room contradicts what is proved of it, and no irradiance is off by more than it says. The bytes are the numbers of the room.
pub fn certificates(bytes: &[u8]) {
    let mut random = Random::of(bytes.iter().map(|&byte| u64::from(byte) << 56).collect());
    let room = Room::new(&mut random);
    let points = room.points(&mut random);
    if let Some(answer) = own(&room, &points) {
        let worst = room.worst(&points, &answer);
        assert!(!worst.is_finding(), "{}: {room:?}", worst.at);
    }
}
