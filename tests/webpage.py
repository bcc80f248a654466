"""A page as a program reads it, and text that no page may obey."""

from html.parser import HTMLParser

NASTY = "<script>alert('x')</script>\"><img src=x onerror=y> & {{ 7 * 7 }} \ud800"
VOID = {"meta", "br", "img", "hr", "link", "input"}


class Page(HTMLParser):
    """What stands on a page; an element that is not closed is an error."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.attributes, self.text, self.open = [], [], "", []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += attrs
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data
