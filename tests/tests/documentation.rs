//! Protects the pages of the documentation that are generated.

use shadowstep_tests::catalogue_page::catalogue_page;
use shadowstep_tests::pages::assert_page;

#[test]
fn the_page_of_all_schemes_is_what_their_tables_say() {
    assert_page("schemes.md", &catalogue_page());
}
