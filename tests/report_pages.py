"""A page of HTML as its reader has it: tables, points, pictures; what a page must not have."""

from html.parser import HTMLParser


class Page(HTMLParser):
    """Tables by the heading above them, sentences, pictures, and everything that is fetched."""

    def __init__(self, text):
        super().__init__()
        self.tables, self.points, self.pictures, self.fetched, self.tags = [], [], [], [], []
        self._into, self._row, self._table, self.heading = None, [], None, ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.tags.append(tag)
        self.fetched += [given[name] for name in ("src", "href", "action") if name in given]
        if tag == "img":
            self.pictures.append(given)
        if tag == "table":
            self._table = []
            self.tables.append((self.heading, self._table))
        if tag in ("td", "th", "li", "h1", "h2"):
            self._into = []
        if tag == "tr":
            self._row = []

    def handle_data(self, data):
        if self._into is not None:
            self._into.append(data)

    def handle_endtag(self, tag):
        if tag in ("td", "th", "li", "h1", "h2") and self._into is not None:
            text = " ".join("".join(self._into).split())
            self._into = None
            if tag in ("td", "th"):
                self._row.append(text)
            elif tag == "li":
                self.points.append((self.heading, text))
            else:
                self.heading = text
        if tag == "tr" and self._table is not None:
            self._table.append(self._row)

    def table(self, heading):
        """Rows of the first table below a heading."""
        return next(rows for above, rows in self.tables if above == heading)
