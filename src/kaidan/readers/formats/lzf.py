"""LZF (Marc Lehmann's LibLZF), in which PCD files are compressed."""

from kaidan.readers.opening import Source


def unpacked(packed: bytes, size: int, source: Source) -> bytes:
    """Bytes that were packed, exactly `size` of them.

    A control byte below 32 announces a run of that many plus one bytes as they are. Another one
    has in its three high bits a length (7: the next byte is added), plus two; its five low bits
    and the next byte say how far back the run stands.

    Examples
    --------
    >>> unpacked(bytes([2]) + b"abc" + bytes([0x20 + 0x20, 2]), 7, None)
    b'abcabca'
    """
    out = bytearray()
    at, end = 0, len(packed)
    while at < end and len(out) <= size:
        control = packed[at]
        at += 1
        if control < 32:
            out += packed[at : at + control + 1]
            at += control + 1
            continue
        length = control >> 5
        if at + (2 if length == 7 else 1) > end:
            break
        if length == 7:
            length += packed[at]
            at += 1
        length += 2
        back = ((control & 31) << 8) + packed[at] + 1
        at += 1
        begin = len(out) - back
        if begin < 0:
            raise source.refuse("the compressed points refer to before their beginning")
        if back >= length:
            out += out[begin : begin + length]
        else:
            out += (out[begin:] * (length // back + 1))[:length]
    if len(out) != size:
        raise source.refuse(f"the compressed points unpack to {len(out)} bytes, not {size}")
    return bytes(out)
