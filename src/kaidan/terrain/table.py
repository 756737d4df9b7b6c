"""How a profile stands in a sheet or an answer: as a table of its name, points and doubt."""

from typing import Any


def table_schema(profile: type[Any]) -> Any:
    """Schema for pydantic of a field that holds a profile: itself, or the table of `to_dict`."""
    from pydantic_core import core_schema as cs

    row = cs.list_schema(cs.float_schema(), min_length=2, max_length=2)
    table = cs.typed_dict_schema(
        {
            "name": cs.typed_dict_field(cs.str_schema(), required=False),
            "points": cs.typed_dict_field(cs.list_schema(row)),
            "overhangs": cs.typed_dict_field(cs.bool_schema(), required=False),
            "open_risers": cs.typed_dict_field(cs.bool_schema(), required=False),
            "sigma": cs.typed_dict_field(cs.list_schema(row), required=False),
            "covariance": cs.typed_dict_field(
                cs.list_schema(cs.list_schema(cs.float_schema())), required=False
            ),
        },
        extra_behavior="forbid",
    )
    of_table = cs.no_info_after_validator_function(profile.from_dict, table)
    return cs.json_or_python_schema(
        json_schema=of_table,
        python_schema=cs.union_schema([cs.is_instance_schema(profile), of_table]),
        serialization=cs.plain_serializer_function_ser_schema(profile.to_dict, return_schema=table),
    )
