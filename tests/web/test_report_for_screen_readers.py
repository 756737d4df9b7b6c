"""The report's page of HTML has what a screen reader goes by, also printed to PDF by a browser."""

import re
from collections import Counter

import kaidan
from kaidan.documents import report_bytes


def test_printed_by_chromium_it_is_a_tagged_pdf(chromium):
    found = kaidan.report("absolem", "ibc", flippers="flat", friction=1.2)
    page = chromium.new_page()
    page.set_content(report_bytes(found, "html").decode())
    printed = page.pdf(tagged=True)
    html = page.content()
    page.close()
    tags = Counter(tag.decode() for tag in re.findall(rb"/S /(\w+)", printed))
    assert b"/StructTreeRoot" in printed
    assert b"/Lang (en)" in printed
    assert tags["H1"] == html.count("<h1")
    assert tags["H2"] == html.count("<h2")
    assert tags["TH"] >= html.count("<th ")  # of a table over several pages again
    assert tags["Figure"] == len(re.findall(rb"/Alt", printed)) == html.count("<img")
