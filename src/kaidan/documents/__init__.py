"""Documents: what `text` says and `figures` draw of an answer, put on paper or on a page.

Nothing is computed and no sentence is written here.
"""

from kaidan.documents.report_file import FORMATS as FORMATS
from kaidan.documents.report_file import document_format as document_format
from kaidan.documents.report_file import report_bytes as report_bytes
